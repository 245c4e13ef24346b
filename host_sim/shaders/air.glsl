// What the air between the eye and a place puts before it. In shelters no snow falls, and less light comes in.
const int kAirShelters = 6;
uniform int u_air_count;
uniform mat4 u_air_from_rel[kAirShelters];  // to 0 .. 1 in each shelter that the way to a draw's places may lead through
uniform float u_air_lit[kAirShelters];      // how bright its air is, by that in the open

// Shares of the way to a place: x in shelters, y the same by how bright they are. What lies in two at once, where a tunnel's pieces meet, counts
// once.
vec2 shelteredShare(vec3 place) {
  vec2 share = vec2(0.0), spans[kAirShelters];
  for (int i = 0; i < u_air_count; ++i) {
    vec3 from = u_air_from_rel[i][3].xyz, way = mat3(u_air_from_rel[i]) * place;
    way = mix(way, vec3(1e-6), lessThan(abs(way), vec3(1e-6)));
    vec3 one = -from / way, other = one + 1.0 / way, enters = min(one, other), leaves = max(one, other);
    vec2 span = clamp(vec2(max(enters.x, max(enters.y, enters.z)), min(leaves.x, min(leaves.y, leaves.z))), 0.0, 1.0);
    spans[i] = span;
    float part = max(span.y - span.x, 0.0);
    for (int j = 0; j < i; ++j) part -= max(min(span.y, spans[j].y) - max(span.x, spans[j].x), 0.0);
    part = max(part, 0.0);
    share += part * vec2(1.0, u_air_lit[i]);
  }
  return share;
}

// Beer and Lambert's law along the parts in the open and in shelters, and the light that is scattered in on the way (Koschmieder 1924). As if
// all shelters lay before the place, as they do where it is in one.
vec4 veiled(vec4 colour, vec3 place) {
  vec2 sheltered = u_air_count > 0 ? shelteredShare(place) : vec2(0.0);
  float way_m = length(place);
  float open = exp(-frame.haze.w * way_m * (1.0 - sheltered.x)), inside = exp(-frame.screen.w * way_m * sheltered.x);
  float airlight = 1.0 - open + open * (1.0 - inside) * sheltered.y / max(sheltered.x, 1e-6);
  return vec4(colour.rgb * (open * inside) + frame.haze.rgb * (airlight * colour.a), colour.a);
}
