// Light from everywhere. An image stands in a texture at its origin, bilinear between texel centres and around the seam; maps made of it
// stand in the rows below.

#ifdef ENVIRONMENT_UNIFORM
uniform vec3 u_environment_uniform;
vec3 environment_radiance(vec3 direction) { return u_environment_uniform; }
#else
uniform sampler2D u_environment;
uniform ivec2 u_environment_size;
// Turns directions of view space to those of the image.
uniform mat3 u_environment_from_view;

// The part of the texture that begins at origin, read as an equirect.
vec4 environment_part(ivec2 origin, ivec2 size, vec3 direction) {
    return texture_bilinear(u_environment, equirect_coordinates(direction), origin, size, WRAP_REPEAT, WRAP_CLAMP_TO_EDGE);
}

// What the image holds in a unit direction of view space.
vec4 environment_texel(vec3 direction) { return environment_part(ivec2(0), u_environment_size, u_environment_from_view * direction); }

// What arrives from there.
vec3 environment_radiance(vec3 direction) { return environment_texel(direction).rgb; }
#endif
