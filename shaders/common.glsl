// What every file uses. Before it the program states MIN_N_DOT_V (the floor of N.V that golden and renderer share) and SHADING_PRECISION.

const highp float PI = 3.14159265358979;
const highp float INV_PI = 0.318309886183791;

// What a share in [0, 1] leaves of 1, in x rest(a) + y a. Not mix(), which may be x + (y - x) a: where y is the smaller by far it keeps no
// more than a last digit of what it takes away, as of a smooth metal's faint lobe beside a dielectric. Of 1.0 - a compilers make a mix().
float rest(float share) { return max(1.0 - share, 0.0); }

float max3(vec3 v) { return max(max(v.x, v.y), v.z); }

// v / |v|, or the fallback where v has no direction.
vec3 normalize_or(vec3 v, vec3 fallback) {
    float squared = dot(v, v);
    return squared > 1e-30 ? v * inversesqrt(squared) : fallback;
}
