// A scene's surface: metallic-roughness, lit by sky, sun and the few lamps in reach, wet where rain falls on it, veiled by the air.
// Variants (one program each, for software renderers do not skip what a branch leaves out):
//   BASE_MAP ROUGHNESS_MAP NORMAL_MAP GLOW_MAP MASK   what the material has
//   GLOSSY    mirrors the environment cube; else its mean light only
//   SHELTER   a volume with its measured sky visibility is near
//   SUN       the sun shines, with shadow map
//   MIRROR    wet ground with a mirror picture of what stands above it
//   CAR_ABOVE a car shades the ground below it, and hides lamps
in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv;
in vec4 v_colour;
#ifdef NORMAL_MAP
in vec4 v_tangent;
#endif

layout(location = 0) out vec4 out_colour;

uniform vec4 u_base;
uniform vec4 u_surface;      // metallic, roughness, cutoff, normal scale
uniform vec3 u_glow;
uniform vec2 u_wet;          // x: how wet it can get, y: how much of a glossy film it holds
uniform float u_open;        // share of the sky's light that reaches the place as a whole
uniform float u_roofed;      // 1: what stands above a shelter hides lamps too, as a car's roof does
uniform int u_lamp_count;
uniform ivec4 u_lamps[4];
#ifdef SHELTER
uniform mat4 u_grid_from_rel[2];  // to 0..1 in the measured box
uniform vec4 u_grid[2];           // xyz: share of the box that is its soft border, w: how far from the surface is measured (m)
uniform float u_dry[2];           // 1: no rain falls in it
uniform int u_grid_count;
#endif

layout(binding = 0) uniform sampler2D u_base_map;
layout(binding = 1) uniform sampler2D u_roughness_map;
layout(binding = 2) uniform sampler2D u_normal_map;
layout(binding = 3) uniform sampler2D u_glow_map;
layout(binding = 4) uniform samplerCube u_environment;
layout(binding = 5) uniform sampler2DShadow u_shadow;
layout(binding = 6) uniform sampler3D u_visibility0;
layout(binding = 7) uniform sampler3D u_visibility1;
layout(binding = 8) uniform sampler2D u_mirror;

// Split-sum scale and bias of the reflectance at normal incidence (Karis 2014, analytic fit).
vec2 reflectanceTerms(float roughness, float facing) {
  const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
  const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
  vec4 r = roughness * c0 + c1;
  float a = min(r.x * r.x, exp2(-9.28 * facing)) * r.x + r.y;
  return vec2(-1.04, 1.04) * a + r.zw;
}

// Albedo of a porous surface soaked with water: Lekner & Dorf 1988, eqs. for n = 1.5.
vec3 wetAlbedo(vec3 dry) {
  vec3 a = 1.0 - dry;
  vec3 wet = a * (dry * 1.068 + a);
  return 1.0 - 0.9796 * wet / (1.0 - 0.475 * (1.0 - wet));
}

// GGX lobe times Smith visibility (Schlick's k), Fresnel by Schlick.
float highlight(float alpha2, float facing, float lit, float half_facing) {
  float d = half_facing * half_facing * (alpha2 - 1.0) + 1.0;
  float k = sqrt(alpha2) * 0.5;
  return alpha2 / (3.14159 * d * d * 4.0 * (facing * (1.0 - k) + k) * (lit * (1.0 - k) + k));
}

// Slow pattern of where water stands: 0 .. 1, metres in.
float puddles(vec2 p) {
  vec2 q = p * 0.37 + 0.9 * sin(p.yx * 0.23);
  float broad = sin(q.x) * sin(q.y);
  vec2 r = p * 1.7 + 0.7 * sin(p.yx * 1.1 + 1.3);
  return clamp(0.5 + 0.4 * broad + 0.2 * sin(r.x) * sin(r.y), 0.0, 1.0);
}

// A dipped headlight: brightest a degree below the horizon, a tenth of that 10 degrees down, half of it 9.5 degrees to a side, and above the
// cut-off what UNECE R112 leaves (0.7 lx at 25 m are 440 cd). The shape between those points is chosen. As render/low_beam.cpp.
float lowBeam(vec3 away, vec3 aim) {
  float down = aim.z + 0.0436 - away.z;
  float aside = aim.x * away.y - aim.y * away.x;
  float below = smoothstep(-0.003, 0.012, down) / (1.0 + down * down * 278.0);
  float ahead = dot(away, aim);
  return ahead > 0.0 ? below * exp2(-36.0 * aside * aside) + 0.016 * ahead : 0.0;
}

#ifdef CAR_ABOVE
// What the car lets through of a lamp's light, both in its frame: less the longer the way in its body is, as that is rounder than the box it is
// taken for (by eye). Its own lamps stand in its skin and shine away from it.
float pastCar(vec3 place, vec3 lamp) {
  const float kClearance_m = 0.2, kSkin_m = 0.4, kThrough_per_m = 4.0;
  vec3 half_size = vec3(frame.car.xy, 0.5 * (frame.car.w - kClearance_m)), middle = vec3(frame.car.z, 0.0, kClearance_m + half_size.z);
  vec3 way = lamp - place, to_middle = middle - place;
  way = mix(way, vec3(1e-4), lessThan(abs(way), vec3(1e-4)));
  vec3 one = (to_middle - half_size) / way, other = (to_middle + half_size) / way, enters = min(one, other), leaves = max(one, other);
  float through = min(min(leaves.x, min(leaves.y, leaves.z)), 1.0) - max(max(enters.x, max(enters.y, enters.z)), 0.0);
  bool own = all(lessThan(abs(lamp - middle), half_size + kSkin_m));
  return own ? 1.0 : exp(-kThrough_per_m * length(way) * max(through, 0.0));
}
#endif

void main() {
  vec4 base = u_base * v_colour;
#ifdef BASE_MAP
  vec4 texel = texture(u_base_map, v_uv);
  base *= vec4(linearFromSrgb(texel.rgb), texel.a);
#endif
#ifdef MASK
  // Distant mips average leaves away; the cutoff follows, so that trees stay as dense as they are near.
  float lod = textureQueryLod(u_base_map, v_uv).x;
  if (base.a * (1.0 + 0.25 * max(lod, 0.0)) < u_surface.z) discard;
#endif
  vec3 n = normalize(gl_FrontFacing ? v_normal : -v_normal);
  float up = n.z;
#ifdef NORMAL_MAP
  vec2 bump = (texture(u_normal_map, v_uv).xy * 2.0 - 1.0) * u_surface.w;
#endif
  float metallic = u_surface.x;
  float roughness = u_surface.y;
#ifdef ROUGHNESS_MAP
  vec2 rm = texture(u_roughness_map, v_uv).gb;
  roughness *= rm.x;
  metallic *= rm.y;
#endif

  float dry_roughness = roughness;

  float distance_m = length(v_position);
  vec3 to_eye = -v_position / max(distance_m, 1e-4);

  // How much of the sky is seen from here: x by the place, dry: where no rain comes.
  float dry = 0.0;
  float shelter = 0.0;
  vec4 seen = vec4(0.0);  // mean and gradient of the light that comes in, relative to an overcast zenith
#ifdef SHELTER
  for (int i = 0; i < u_grid_count; ++i) {
    vec3 at = (u_grid_from_rel[i] * vec4(v_position + n * u_grid[i].w, 1.0)).xyz;
    vec3 inside = clamp(min(at, 1.0 - at) / u_grid[i].xyz, 0.0, 1.0);
    float share = inside.x * inside.y * inside.z * (1.0 - shelter);
    seen += share * (i == 0 ? texture(u_visibility0, at) : texture(u_visibility1, at));
    shelter += share;
    dry = max(dry, u_dry[i] * inside.x * inside.y * inside.z);
  }
#endif

  float wet = frame.air.x * u_wet.x * smoothstep(-0.2, 0.6, up) * (1.0 - smoothstep(0.3, 0.9, dry));
  float film = wet * u_wet.y * smoothstep(0.7, 0.98, up);
  vec3 albedo = mix(base.rgb, wetAlbedo(base.rgb), wet);
  float f0 = 0.04;
#ifdef GLOSSY
  vec2 ground = v_position.xy + frame.eye.xy;
  float pool = film * puddles(ground);
  roughness = mix(roughness, mix(0.3, 0.1, pool), film);
  f0 = mix(f0, 0.02, film);
#endif
#ifdef NORMAL_MAP
  float flatten = 1.0 - 0.85 * film;
  vec3 t = normalize(v_tangent.xyz);
  n = normalize(n + flatten * (bump.x * t + bump.y * v_tangent.w * cross(n, t)));
#endif
  vec3 diffuse = albedo * (1.0 - metallic);
  vec3 reflectance = mix(vec3(f0), base.rgb, metallic);

  vec3 light = skyLight(n) * u_open;
  vec3 mirrored = reflect(-to_eye, n);
  float reach = u_open;
#ifdef CAR_ABOVE
  vec3 in_car = (frame.car_from_rel * vec4(v_position, 1.0)).xyz;
  vec2 beyond = max(abs(in_car.xy - vec2(frame.car.z, 0.0)) - frame.car.xy, 0.0);
  // Sky light below a body some 0.2 m above the ground: none under it, all of it a metre off.
  float shade = 1.0 - 0.92 * exp(-dot(beyond, beyond) * 9.0 - 1.2 * (beyond.x + beyond.y)) * step(in_car.z, 0.3);
  light *= shade;
  reach *= shade;
#endif
#ifdef SHELTER
  // Irradiance / pi from mean and gradient; an open overcast sky gives 7/9 of its zenith on level ground.
  vec3 zenith = skyLight(vec3(0.0, 0.0, 1.0)) * (9.0 / 7.0) * u_open;
  vec3 inner = zenith * (max(seen.x + 0.667 * dot(seen.yzw, n), 0.0) + 0.15 * seen.x);
  light = light * (1.0 - shelter) + inner;
  float open_sky = max(0.333 + 0.583 * mirrored.z, 0.12);
  reach *= 1.0 - shelter + clamp(max(seen.x * (1.0 / 0.333) * shelter * 0.1, seen.x + dot(seen.yzw, mirrored)) / open_sky, 0.0, shelter);
#endif
  float facing = max(dot(n, to_eye), 0.02);
  vec2 terms = reflectanceTerms(roughness, facing);
  vec3 reflected = reflectance * terms.x + terms.y;
#ifdef GLOSSY
  vec3 around = textureLod(u_environment, mirrored, sqrt(roughness) * frame.air.y).rgb * frame.air.z;
#else
  vec3 around = skyLight(mirrored);
#endif
  around *= reach;
#ifdef MIRROR
  // What stands on the ground, from a picture taken below it; where the ground leaves the plane, the surroundings at infinity.
  float off = abs(dot(frame.plane.xyz, v_position) - frame.plane.w) / (0.05 + 0.01 * distance_m);
  float flat_here = film * exp(-off * off);
  vec2 at = gl_FragCoord.xy * frame.screen.xy + (n.xy - frame.plane.xy) * vec2(0.05, 0.15);
  float spread = 1.0 + 2.2 * (1.0 - pool);
  float high = (0.01 + 0.03 * (1.0 - pool)) * clamp(20.0 / distance_m, 0.3, 1.5);
  vec3 stood = 0.4 * textureLod(u_mirror, at, spread).rgb + 0.3 * textureLod(u_mirror, at - vec2(0.0, high), spread).rgb +
               0.3 * textureLod(u_mirror, at + vec2(0.0, high), spread).rgb;
  around = mix(around, stood, flat_here);
#endif
  vec3 shine = around * reflected;
  float alpha2 = roughness * roughness;
  alpha2 = max(alpha2 * alpha2, 2e-4);

#ifdef SUN
  vec3 in_map = (frame.shadow_from_rel * vec4(v_position + n * 0.06, 1.0)).xyz;
  float sunlit = 0.25 * (texture(u_shadow, in_map + vec3(-3e-4, -1e-4, 0.0)) + texture(u_shadow, in_map + vec3(1e-4, -3e-4, 0.0)) +
                         texture(u_shadow, in_map + vec3(3e-4, 1e-4, 0.0)) + texture(u_shadow, in_map + vec3(-1e-4, 3e-4, 0.0)));
  float by_sun = max(dot(n, frame.to_sun.xyz), 0.0);
  vec3 sun = frame.sun.rgb * (by_sun * sunlit * step(0.5, u_open));
  vec3 half_sun = normalize(to_eye + frame.to_sun.xyz);
  float fresnel_sun = exp2(-9.28 * max(dot(half_sun, to_eye), 0.0));
  light += sun * (1.0 / 3.14159);
  shine += sun * highlight(alpha2, facing, by_sun, max(dot(n, half_sun), 0.0)) * (reflectance + (1.0 - reflectance) * fresnel_sun);
#endif

  // Rough ground sends light back to where it came from: Oren & Nayar's (1994) term of that with facets of 0.6 rad, by which dry asphalt returns
  // some 10 mcd/m^2 for a lux of headlight 30 m ahead, as it does by EN 1436. A film of water drowns most of it (unsourced).
  float returned = 0.36 * u_wet.x * (1.0 - metallic) * smoothstep(0.5, 0.8, dry_roughness) * (1.0 - 0.7 * film);
  float level = max(dot(n, to_eye), 0.0);
  for (int i = 0; i < u_lamp_count; ++i) {
    int lamp = u_lamps[i >> 2][i & 3];
    vec4 place = frame.lamp_place[lamp];
    vec4 aim = frame.lamp_aim[lamp];
    vec4 intensity = frame.lamp_intensity[lamp];
    vec3 to_lamp = place.xyz - v_position;
    float d2 = dot(to_lamp, to_lamp);
    to_lamp *= inversesqrt(d2);
    float cone = clamp((dot(-to_lamp, aim.xyz) - aim.w) * intensity.w, 0.0, 1.0);
    float window = clamp(1.0 - d2 * d2 * place.w * place.w, 0.0, 1.0);
    float lit = clamp(dot(n, to_lamp), 0.0, 1.0);
    float beam = intensity.w < 0.0 ? lowBeam(-to_lamp, aim.xyz) : cone * cone;
#ifdef CAR_ABOVE
    beam *= pastCar(in_car, (frame.car_from_rel * vec4(place.xyz, 1.0)).xyz);
#endif
#ifdef SHELTER
    // The roof that keeps the sky out keeps a lamp above it out.
    float through = (seen.x + dot(seen.yzw, to_lamp)) / max(0.333 + 0.583 * to_lamp.z, 0.12);
    beam *= 1.0 - u_roofed * (shelter - clamp(through, 0.0, shelter));
#endif
    vec3 incoming = intensity.rgb * (beam * window * window * lit / max(d2, 0.05));
    vec3 half_way = normalize(to_eye + to_lamp);
    float fresnel = exp2(-9.28 * max(dot(half_way, to_eye), 0.0));
    float against = max(dot(to_lamp, to_eye) - lit * level, 0.0) / max(max(lit, level), 0.02);
    light += incoming * ((1.0 + returned * against) / 3.14159);
    shine += incoming * highlight(alpha2, facing, lit, max(dot(n, half_way), 0.0)) * (reflectance + (1.0 - reflectance) * fresnel);
  }

  vec3 glow = u_glow * frame.air.w;
#ifdef GLOW_MAP
  glow *= linearFromSrgb(texture(u_glow_map, v_uv).rgb);
#endif
#ifdef BLEND
  vec4 colour = vec4(diffuse * light * base.a + shine + glow, max(base.a, terms.y));
#else
  vec4 colour = vec4(diffuse * light + shine + glow, 1.0);
#endif
  out_colour = veiled(colour, v_position);
}
