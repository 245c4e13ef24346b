// Where a latitude-longitude picture shows a direction: the world's +x in its middle column, +y left of it, up in row 0.
vec2 latLong(vec3 to) {
  return vec2(0.5 - atan(to.y, to.x) / 6.2831853, acos(clamp(normalize(to).z, -1.0, 1.0)) / 3.14159265);
}
