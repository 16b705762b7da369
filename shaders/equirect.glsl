// Where an equirect shows a unit direction: u = 0.5 + atan(z, x) / (2 pi), v = acos(y) / pi from the top row. GLSL leaves atan(0, 0) open.
vec2 equirect_coordinates(vec3 direction) {
    float azimuth = direction.x == 0.0 && direction.z == 0.0 ? 0.0 : atan(direction.z, direction.x);
    return vec2(0.5 + azimuth / (2.0 * PI), acos(clamp(direction.y, -1.0, 1.0)) / PI);
}
