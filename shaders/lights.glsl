// Punctual lights, KHR_lights_punctual, in view space. Four vectors a light:
//   0: rgb colour * intensity (lux or candela); a type: 0 directional, 1 point, 2 spot
//   1: xyz toward a directional light, or a light's position; a 1 / range, 0 without a range
//   2: xyz a spot's axis, the way its light travels; a 1 / max(0.001, cos(inner) - cos(outer))
//   3: x cos(outer)

uniform int u_light_count;
#ifdef MANY_LIGHTS
uniform sampler2D u_lights;
vec4 light_vector(int light, int i) { return texelFetch(u_lights, ivec2(4 * (light & 255) + i, light >> 8), 0); }
#else
uniform vec4 u_lights[4 * MAX_UNIFORM_LIGHTS];
vec4 light_vector(int light, int i) { return u_lights[4 * light + i]; }
#endif

// What arrives from one light: the unit vector toward it and the illuminance on a surface that faces it, in lux.
struct IncidentLight {
    vec3 L;
    vec3 E;
};

#if defined(LIGHT_POINT) || defined(LIGHT_SPOT)
// "Range Property": attenuation = max(min(1 - (d / range)^4, 1), 0) / d^2.
IncidentLight light_from_position(int light, vec3 position) {
    vec4 place = light_vector(light, 1);
    vec3 to_light = place.xyz - position;
    float squared = max(dot(to_light, to_light), 1e-30);
    float share = squared * place.w * place.w;
    float attenuation = clamp(1.0 - share * share, 0.0, 1.0) / squared;
    return IncidentLight(to_light * inversesqrt(squared), light_vector(light, 0).rgb * attenuation);
}
#endif

#ifdef LIGHT_SPOT
// "Inner and Outer Cone Angles": (cd - cos(outer)) * scale is the printed cd * scale + offset with the product taken last, which keeps
// the digits that a narrow rim needs.
float light_cone(int light, vec3 L) {
    vec4 axis = light_vector(light, 2);
    float cd = dot(axis.xyz, -L);
    float attenuation = clamp((cd - light_vector(light, 3).x) * axis.w, 0.0, 1.0);
    return attenuation * attenuation;
}
#endif

IncidentLight incident_light(int light, vec3 position) {
#if defined(LIGHT_DIRECTIONAL) && !defined(LIGHT_POINT) && !defined(LIGHT_SPOT)
    return IncidentLight(light_vector(light, 1).xyz, light_vector(light, 0).rgb);
#else
#ifdef LIGHT_DIRECTIONAL
    float type = light_vector(light, 0).a;
    if (type == 0.0) return IncidentLight(light_vector(light, 1).xyz, light_vector(light, 0).rgb);
#endif
    IncidentLight incident = light_from_position(light, position);
#ifdef LIGHT_SPOT
#if defined(LIGHT_POINT)
    if (light_vector(light, 0).a == 2.0)
#endif
    incident.E *= light_cone(light, incident.L);
#endif
    return incident;
#endif
}
