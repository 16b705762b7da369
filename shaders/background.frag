// The environment as the camera sees it. Directions are those of view space.

#ifndef ENVIRONMENT_UNIFORM
uniform vec2 u_viewport;
// Half of what the camera sees at distance 1, across and up; 0 for an orthographic one, whose rays all run alike.
uniform vec2 u_view_extent;
#endif
layout(location = 0) out vec4 out_color;

void main() {
#ifdef ENVIRONMENT_UNIFORM
    vec3 direction = vec3(0.0, 0.0, -1.0);
#else
    vec2 ndc = gl_FragCoord.xy / u_viewport * 2.0 - 1.0;
    vec3 direction = normalize(vec3(ndc * u_view_extent, -1.0));
#endif
    out_color = vec4(environment_radiance(direction), 1.0);
}
