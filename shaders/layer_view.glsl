// What one layer sees: its normal, the view on that normal's side, and their cosine in [MIN_N_DOT_V, 1].
struct LayerView {
    vec3 N;
    vec3 V;
    float NdotV;
};

// An interpolated or mapped normal can turn away from the viewer: V is then mirrored at the normal's plane.
LayerView layer_view(vec3 N, vec3 V) {
    float NdotV = dot(N, V);
    return LayerView(N, V - 2.0 * min(NdotV, 0.0) * N, clamp(abs(NdotV), MIN_N_DOT_V, 1.0));
}
