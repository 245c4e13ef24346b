in vec2 v_uv;
#ifdef MASK
layout(binding = 0) uniform sampler2D u_base_map;
#endif
void main() {
#ifdef MASK
  if (texture(u_base_map, v_uv).a < 0.4) discard;
#endif
}
