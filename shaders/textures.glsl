// Texture filtering of OpenGL ES 3.0.6, section 3.8.10, done here on texels by texelFetch: a driver's fixed-function filter may round
// weights to 8 bits, and its sRGB decoding is its own. Each texture's wrap and filter come as constants, so only what it uses is compiled.

precision highp usampler2D;

const int WRAP_REPEAT = 0;
const int WRAP_MIRRORED_REPEAT = 1;
const int WRAP_CLAMP_TO_EDGE = 2;
const int FILTER_NEAREST = 0;
const int FILTER_LINEAR = 1;
const int MIP_NONE = 0;
const int MIP_NEAREST = 1;
const int MIP_LINEAR = 2;
const int STORED_FLOATS = 0;
const int STORED_LINEAR_CODES = 1;
const int STORED_SRGB_CODES = 2;

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

// Section 3.8.10.3: the four texels around a point, and how far it stands from the first toward the others.
struct Corners {
    ivec2 s;
    ivec2 t;
    vec2 weight;
};

Corners bilinear_corners(vec2 uv, ivec2 size, int wrap_s, int wrap_t) {
    vec2 st = clamp(uv * vec2(size), -1e9, 1e9);
    vec2 corner = floor(st - 0.5);
    ivec2 i0 = ivec2(corner);
    return Corners(ivec2(wrap_texel(i0.x, size.x, wrap_s), wrap_texel(i0.x + 1, size.x, wrap_s)),
                   ivec2(wrap_texel(i0.y, size.y, wrap_t), wrap_texel(i0.y + 1, size.y, wrap_t)), st - 0.5 - corner);
}

// The part of an image of floats that begins at origin, bilinear.
vec4 texture_bilinear(sampler2D image, vec2 uv, ivec2 origin, ivec2 size, int wrap_s, int wrap_t) {
    Corners c = bilinear_corners(uv, size, wrap_s, wrap_t);
    ivec2 s = origin.x + c.s;
    ivec2 t = origin.y + c.t;
    vec4 top = mix(texelFetch(image, ivec2(s.x, t.x), 0), texelFetch(image, ivec2(s.y, t.x), 0), c.weight.x);
    vec4 bottom = mix(texelFetch(image, ivec2(s.x, t.y), 0), texelFetch(image, ivec2(s.y, t.y), 0), c.weight.x);
    return mix(top, bottom, c.weight.y);
}

// A picture with its mipmaps is one texture of one level, for llvmpipe takes the level of a texelFetch from a quad's first pixel, and other
// drivers may. Its texels are 128 bits: four floats, or at level 0 the codes of four texels of a row, 8 bits each from red upwards, a row
// of even number being followed by the next one on the same line. Level 1 lies under level 0, the others side by side under level 1, each
// far enough from the one before; after the last level stands a copy of it.
ivec2 level_origin(ivec2 size, int storage, int level) {
    if (level == 0) return ivec2(0);
    int row = storage == STORED_FLOATS ? size.y : (size.y + 1) >> 1;
    if (level == 1) return ivec2(0, row);
    return ivec2((size.x >> 1) - (size.x >> (level - 1)) + level - 2, row + max(size.y >> 1, 1));
}

// IEC 61966-2-1. x^2.4 as x^2 x^0.4, whose exponent is small: exp2 and log2 may be off by some digits of it.
vec3 srgb_to_linear(vec3 code) {
    vec3 x = (code + 0.055) * (1.0 / 1.055);
    return mix(x * x * exp2(0.4 * log2(x)), code * (1.0 / 12.92), lessThanEqual(code, vec3(0.04045)));
}

// A texel of which this is the code. Written three times in a row, the 8 bits of c are 2^24 - 1 times c / 255, exactly; what that lacks of
// 2^24 times is added with the one rounding.
vec4 decoded(uint code, int storage) {
    ivec4 c = ivec4(uvec4(code, code >> 8, code >> 16, code >> 24) & 255u);
    vec4 value = vec4(c * 0x010101) * (1.0 / 16777216.0) + vec4(c) * (1.0 / 255.0 / 16777216.0);
    return storage == STORED_SRGB_CODES ? vec4(srgb_to_linear(value.rgb), value.a) : value;
}

// The texel at (s, t) of the level that begins at origin; coded: of level 0, stored as codes, of a picture that wide.
vec4 picture_texel(usampler2D image, int s, int t, ivec2 origin, bool coded, int width, int storage) {
    ivec2 four = ivec2((s >> 2) + (t & 1) * ((width + 3) >> 2), t >> 1);
    uvec4 bits = texelFetch(image, coded ? four : origin + ivec2(s, t), 0);
    return coded ? decoded(bits[s & 3], storage) : uintBitsToFloat(bits);
}

// One level, nearest or bilinear, of a picture of that size. `coded` is given apart, that no code is decoded for a level other than 0.
vec4 texture_level(usampler2D image, vec2 uv, ivec2 base_size, int level, bool coded, int wrap_s, int wrap_t, int filter_mode,
                   int storage) {
    ivec2 size = max(base_size >> level, ivec2(1));
    ivec2 origin = level_origin(base_size, storage, level);
    if (filter_mode == FILTER_LINEAR) {
        Corners c = bilinear_corners(uv, size, wrap_s, wrap_t);
        vec4 top = mix(picture_texel(image, c.s.x, c.t.x, origin, coded, size.x, storage),
                       picture_texel(image, c.s.y, c.t.x, origin, coded, size.x, storage), c.weight.x);
        vec4 bottom = mix(picture_texel(image, c.s.x, c.t.y, origin, coded, size.x, storage),
                          picture_texel(image, c.s.y, c.t.y, origin, coded, size.x, storage), c.weight.x);
        return mix(top, bottom, c.weight.y);
    }
    ivec2 i = ivec2(floor(clamp(uv * vec2(size), -1e9, 1e9)));
    return picture_texel(image, wrap_texel(i.x, size.x, wrap_s), wrap_texel(i.y, size.y, wrap_t), origin, coded, size.x, storage);
}

// Sections 3.8.10.1 to 3.8.11: scale factor, minification or magnification, choice of levels. Must be called in uniform control flow, for
// its derivatives.
vec4 texture_sample(usampler2D image, vec2 uv, ivec2 size, int wrap_s, int wrap_t, int mag_filter, int min_filter, int mip_filter,
                    int storage) {
    bool coded = storage != STORED_FLOATS;
    if (mip_filter == MIP_NONE && mag_filter == min_filter) {
        return texture_level(image, uv, size, 0, coded, wrap_s, wrap_t, mag_filter, storage);
    }
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
        int d = int(floor(level));
        vec4 finer = texture_level(image, uv, size, d, coded && d == 0, wrap_s, wrap_t, filter_mode, storage);
        vec4 coarser = texture_level(image, uv, size, d + 1, false, wrap_s, wrap_t, filter_mode, storage);
        return mix(finer, coarser, level - float(d));
    }
    int d = 0;
    if (mip_filter == MIP_NEAREST && !magnified) d = int(clamp(ceil(lambda + 0.5) - 1.0, 0.0, float(last)));
    return texture_level(image, uv, size, d, coded && d == 0, wrap_s, wrap_t, filter_mode, storage);
}
