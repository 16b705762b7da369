// The angle from (1, 0) to (x, y), in (-PI, PI], 0 of no direction. GLSL ES promises nothing of its own atan and acos; of these operations it
// does. The polynomial, a minimax fit, leaves 1e-8.
float angle_of(float y, float x) {
    float a = min(abs(x), abs(y)) / max(max(abs(x), abs(y)), 1e-30);
    float s = a * a;
    float high = 0.1057392559 + s * (-0.07366692888 + s * (0.04112170934 + s * (-0.01513244611 + s * 0.002622222483)));
    float angle = a * (1.0 + s * (-0.3333298705 + s * (0.1999039639 + s * (-0.1418597354 + s * high))));
    if (abs(y) > abs(x)) angle = 0.5 * PI - angle;
    if (x < 0.0) angle = PI - angle;
    return y < 0.0 ? -angle : angle;
}

// Where an equirect shows a unit direction: u = 0.5 + atan(z, x) / (2 pi), v = acos(y) / pi from the top row.
vec2 equirect_coordinates(vec3 direction) {
    float sine = sqrt(max(dot(direction.xz, direction.xz), 1e-30));
    return vec2(0.5 + angle_of(direction.z, direction.x) / (2.0 * PI), angle_of(sine, direction.y) / PI);
}
