// The environment behind everything: of the sky's cube, or (PICTURE) of the latitude-longitude picture that was given, as sharp as it is.
in vec2 v_at;
layout(location = 0) out vec4 out_colour;
uniform mat4 u_rel_from_clip;
#ifdef PICTURE
layout(binding = 0) uniform sampler2D u_picture;
vec3 surroundings(vec3 to) { return textureLod(u_picture, latLong(to), 0.0).rgb; }
#else
layout(binding = 4) uniform samplerCube u_environment;
vec3 surroundings(vec3 to) { return textureLod(u_environment, to, 0.0).rgb * frame.air.z; }
#endif
void main() { out_colour = vec4(surroundings((u_rel_from_clip * vec4(v_at, 1.0, 1.0)).xyz), 1.0); }
