// What every file uses. Before it the program states MIN_N_DOT_V (the floor of N.V that golden and renderer share) and SHADING_PRECISION.

const highp float PI = 3.14159265358979;

float max3(vec3 v) { return max(max(v.x, v.y), v.z); }

// v / |v|, or the fallback where v has no direction.
vec3 normalize_or(vec3 v, vec3 fallback) {
    float squared = dot(v, v);
    return squared > 1e-30 ? v * inversesqrt(squared) : fallback;
}
