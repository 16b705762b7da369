// Texture filtering of OpenGL ES 3.0.6, section 3.8.10, done here on float texels by texelFetch: a driver's fixed-function filter may round
// weights to 8 bits, and its sRGB decoding is its own. Each texture's wrap and filter come as constants, so only what it uses is compiled.

const int WRAP_REPEAT = 0;
const int WRAP_MIRRORED_REPEAT = 1;
const int WRAP_CLAMP_TO_EDGE = 2;
const int FILTER_NEAREST = 0;
const int FILTER_LINEAR = 1;
const int MIP_NONE = 0;
const int MIP_NEAREST = 1;
const int MIP_LINEAR = 2;

// Table 3.19: the texel a coordinate falls on. The quotient is only approximate (a / b within 2.5 ulp), so the remainder is put right after.
int wrap_texel(int i, int size, int wrap) {
    if (wrap != WRAP_CLAMP_TO_EDGE) {
        int period = wrap == WRAP_MIRRORED_REPEAT ? 2 * size : size;
        i -= period * int(floor(float(i) / float(period)));
        if (i < 0) i += period;
        if (i >= period) i -= period;
        if (wrap == WRAP_MIRRORED_REPEAT && i >= size) i = 2 * size - 1 - i;
    }
    return clamp(i, 0, size - 1);
}

// A mipmapped picture is uploaded as one texture of one level, for llvmpipe takes the level of a texelFetch from a quad's first pixel, and
// other drivers may: level 0 at the origin, the others in a column beside it, each far enough below the one before. Its size follows from
// the texture's, 3/2 of its width and MIP_ROWS more rows.
const int MIP_ROWS = 16;

ivec2 picture_size(sampler2D image, int mip_filter) {
    ivec2 size = textureSize(image, 0);
    return mip_filter == MIP_NONE ? size : ivec2(2 * size.x / 3, size.y - MIP_ROWS);
}

ivec2 level_origin(ivec2 size, int level) {
    return level == 0 ? ivec2(0) : ivec2(size.x, size.y - (size.y >> (level - 1)) + level - 1);
}

// Section 3.8.10.3: the four texels around a point of the part of an image that begins at origin.
vec4 texture_bilinear(sampler2D image, vec2 uv, ivec2 origin, ivec2 size, int wrap_s, int wrap_t) {
    vec2 st = clamp(uv * vec2(size), -1e9, 1e9);
    vec2 corner = floor(st - 0.5);
    vec2 weight = st - 0.5 - corner;
    ivec2 i0 = ivec2(corner);
    ivec2 s = origin.x + ivec2(wrap_texel(i0.x, size.x, wrap_s), wrap_texel(i0.x + 1, size.x, wrap_s));
    ivec2 t = origin.y + ivec2(wrap_texel(i0.y, size.y, wrap_t), wrap_texel(i0.y + 1, size.y, wrap_t));
    vec4 top = mix(texelFetch(image, ivec2(s.x, t.x), 0), texelFetch(image, ivec2(s.y, t.x), 0), weight.x);
    vec4 bottom = mix(texelFetch(image, ivec2(s.x, t.y), 0), texelFetch(image, ivec2(s.y, t.y), 0), weight.x);
    return mix(top, bottom, weight.y);
}

// One level, nearest or bilinear.
vec4 texture_level(sampler2D image, vec2 uv, ivec2 base_size, int level, int wrap_s, int wrap_t, int filter_mode) {
    ivec2 size = max(base_size >> level, ivec2(1));
    ivec2 origin = level_origin(base_size, level);
    if (filter_mode == FILTER_LINEAR) return texture_bilinear(image, uv, origin, size, wrap_s, wrap_t);
    ivec2 i = ivec2(floor(clamp(uv * vec2(size), -1e9, 1e9)));
    return texelFetch(image, origin + ivec2(wrap_texel(i.x, size.x, wrap_s), wrap_texel(i.y, size.y, wrap_t)), 0);
}

// Sections 3.8.10.1 to 3.8.11: scale factor, minification or magnification, choice of levels. Must be called in uniform control flow, for
// its derivatives.
vec4 texture_sample(sampler2D image, vec2 uv, int wrap_s, int wrap_t, int mag_filter, int min_filter, int mip_filter) {
    ivec2 size = picture_size(image, mip_filter);
    if (mip_filter == MIP_NONE && mag_filter == min_filter) return texture_level(image, uv, size, 0, wrap_s, wrap_t, mag_filter);
    vec2 dx = dFdx(uv) * vec2(size);
    vec2 dy = dFdy(uv) * vec2(size);
    float rho = max(length(dx), length(dy));
    float lambda = log2(max(rho, 1e-20));
    // "c = 0.5 if the magnification filter is LINEAR and the minification filter is NEAREST_MIPMAP_*"
    float c = mag_filter == FILTER_LINEAR && min_filter == FILTER_NEAREST && mip_filter != MIP_NONE ? 0.5 : 0.0;
    bool magnified = lambda <= c;
    int filter_mode = magnified ? mag_filter : min_filter;
    // floor(log2(longest side)), from the float's exponent: log2 itself may fall short at a power of two.
    int last = (floatBitsToInt(float(max(size.x, size.y))) >> 23) - 127;
    if (mip_filter == MIP_LINEAR) {
        float level = magnified ? 0.0 : clamp(lambda, 0.0, float(last));
        int d1 = int(floor(level));
        int d2 = min(d1 + 1, last);
        vec4 finer = texture_level(image, uv, size, d1, wrap_s, wrap_t, filter_mode);
        vec4 coarser = texture_level(image, uv, size, d2, wrap_s, wrap_t, filter_mode);
        return mix(finer, coarser, level - float(d1));
    }
    int d = 0;
    if (mip_filter == MIP_NEAREST && !magnified) d = int(clamp(ceil(lambda + 0.5) - 1.0, 0.0, float(last)));
    return texture_level(image, uv, size, d, wrap_s, wrap_t, filter_mode);
}
