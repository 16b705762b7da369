// The normals of the layers.

in vec3 v_normal;
#ifdef TANGENT
in vec4 v_tangent;
#endif
#ifdef NORMAL_TEXTURE
uniform usampler2D u_normal_texture;
uniform ivec2 u_normal_texture_size;
uniform float u_normal_scale;
#ifdef NORMAL_TEXTURE_TRANSFORM
uniform mat3 u_normal_texture_transform;
#endif
#endif
#ifdef CLEARCOAT_NORMAL_TEXTURE
uniform usampler2D u_clearcoat_normal_texture;
uniform ivec2 u_clearcoat_normal_texture_size;
uniform float u_clearcoat_normal_scale;
#ifdef CLEARCOAT_NORMAL_TEXTURE_TRANSFORM
uniform mat3 u_clearcoat_normal_texture_transform;
#endif
#endif

// The interpolated normal; where it has no direction, the triangle's own, which faces the viewer on a front face.
vec3 interpolated_normal(vec3 position) {
    vec3 facing = normalize_or(cross(dFdx(position), dFdy(position)), vec3(0.0, 0.0, 1.0));
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) facing = -facing;
#endif
    return normalize_or(v_normal, facing);
}

#ifdef TANGENT
// glTF 2.0, section 3.9.3: texel * 2 - 1, x and y times the scale, in the frame (T, B, N) with B = cross(N, T) w of section 3.7.2.1.
vec3 mapped_normal(vec3 N, vec3 texel, float scale) {
    vec3 n = normalize_or((texel * 2.0 - 1.0) * vec3(scale, scale, 1.0), vec3(0.0, 0.0, 1.0));
    vec3 T = normalize_or(v_tangent.xyz, vec3(0.0));
    vec3 B = cross(N, T) * v_tangent.w;
    return normalize_or(T * n.x + B * n.y + N * n.z, N);
}
#endif

// A back face of a double-sided material turns its whole frame round: the final normal is negated (glTF 2.0, section 3.9.6).
vec3 toward_viewer(vec3 N) {
#ifdef DOUBLE_SIDED
    return gl_FrontFacing ? N : -N;
#else
    return N;
#endif
}
