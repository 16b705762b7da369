// Carries a vertex to clip space and its attributes to view space, where everything is shaded: there V needs no camera position, and matrices
// multiplied in double on the CPU keep the digits of scenes far from the origin.

layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_local;

#ifdef NORMAL
layout(location = 1) in vec3 a_normal;
uniform mat4 u_view_from_local;
uniform mat3 u_normal_from_local;
out vec3 v_position;
out vec3 v_normal;
#endif
#ifdef TANGENT
layout(location = 2) in vec4 a_tangent;
out vec4 v_tangent;
#endif
#ifdef TEXCOORD_0
layout(location = 3) in vec2 a_texcoord_0;
out vec2 v_texcoord_0;
#endif
#ifdef TEXCOORD_1
layout(location = 4) in vec2 a_texcoord_1;
out vec2 v_texcoord_1;
#endif
#ifdef VERTEX_COLOR
layout(location = 5) in vec4 a_color;
out vec4 v_color;
#endif

void main() {
    vec4 position = vec4(a_position, 1.0);
    gl_Position = u_clip_from_local * position;
#ifdef NORMAL
    v_position = (u_view_from_local * position).xyz;
    v_normal = u_normal_from_local * a_normal;
#endif
#ifdef TANGENT
    v_tangent = vec4(mat3(u_view_from_local) * a_tangent.xyz, a_tangent.w);
#endif
#ifdef TEXCOORD_0
    v_texcoord_0 = a_texcoord_0;
#endif
#ifdef TEXCOORD_1
    v_texcoord_1 = a_texcoord_1;
#endif
#ifdef VERTEX_COLOR
    v_color = a_color;
#endif
}
