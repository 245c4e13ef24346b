// Volumes, panes, wipers and placed drops that cannot be: each is refused by its code and by the name of what
// is wrong.
#include <cstddef>
#include <random>

#include "bad_arguments.h"

namespace rg::test {
namespace {

struct Volume {
  std::vector<double> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, planes;
  rg_volume_info info;
  explicit Volume(const rg_api& api) { api.default_volume_info(&info); }
  const rg_volume_info* get() {
    info.vertices_m = vertices.empty() ? nullptr : vertices.data();
    info.planes = planes.empty() ? nullptr : planes.data();
    return &info;
  }
};

class BadObjects : public BadArguments {
 protected:
  void expectVolumeRefused(const std::string& what, const std::string& field,
                           const std::function<void(Volume&)>& spoil,
                           rg_result code = RG_ERROR_BAD_ARGUMENT) const {
    Volume volume(api);
    volume.info.vertex_count = 4;
    spoil(volume);
    expectRefused(
        what, [&] { return api.set_volume(scene.instance, 9, volume.get()); }, code, field);
  }
};

TEST_F(BadObjects, volumesThatEncloseNothing) {
  expectVolumeRefused("neither", "vertices or planes", [](Volume& v) { v.vertices.clear(); });
  expectVolumeRefused("both", "vertices or planes", [](Volume& v) { v.planes.assign(16, 0.0); });
  expectVolumeRefused("a count without vertices", "vertices", [](Volume& v) { v.vertices.clear(); });
  expectVolumeRefused("no vertices", "vertices", [](Volume& v) { v.info.vertex_count = 0; });
  expectVolumeRefused("two vertices", "vertices", [](Volume& v) { v.info.vertex_count = 2; });
  expectVolumeRefused("a huge count", "vertices_m", [](Volume& v) { v.info.vertex_count = 0xFFFFFFFF; });
  expectVolumeRefused("NaN", "vertex 1", [](Volume& v) { v.vertices[4] = kNaN; });
  expectVolumeRefused("infinity", "vertex 0", [](Volume& v) { v.vertices[0] = kInfinity; });
  expectVolumeRefused("on a line", "line", [](Volume& v) {
    for (size_t i = 0; i < 12; ++i) v.vertices[i] = static_cast<double>(i / 3);
  });
  expectVolumeRefused("all in one point", "line", [](Volume& v) { v.vertices.assign(12, 1.0); });
  expectVolumeRefused("a name without end", "name", [](Volume& v) {
    static const std::string name(100, 'x');
    v.info.name = name.c_str();
  });
  expectRefused(
      "id 0", [&] { return api.set_volume(scene.instance, 0, Volume(api).get()); }, RG_ERROR_BAD_ARGUMENT,
      "volume id");
}

TEST_F(BadObjects, planesThatLeaveAVolumeOpen) {
  const std::vector<double> box{1, 0, 0, 1, -1, 0, 0, 1, 0, 1, 0, 1, 0, -1, 0, 1, 0, 0, 1, 1, 0, 0, -1, 1};
  const auto refused = [&](const std::string& what, const std::string& field,
                           const std::function<void(Volume&)>& spoil) {
    expectVolumeRefused(what, field, [&](Volume& v) {
      v.vertices.clear();
      v.planes = box;
      v.info.plane_count = 6;
      spoil(v);
    });
  };
  refused("five walls", "enclose", [](Volume& v) { v.info.plane_count = 5; });
  refused("two walls", "planes", [](Volume& v) { v.info.plane_count = 2; });
  refused("a huge count", "planes", [](Volume& v) { v.info.plane_count = 0xFFFFFFFF; });
  refused("NaN", "plane 2", [](Volume& v) { v.planes[8] = kNaN; });
  refused("no unit normal", "plane 0", [](Volume& v) { v.planes[0] = 2.0; });
  refused("inside out", "inside out", [](Volume& v) {
    for (double& x : v.planes) x = -x;
  });
  refused("crossed", "enclose", [](Volume& v) { v.planes[3] = -2.0; });
}

struct Pane {
  std::vector<float> positions{1, 0.2f, 1, 1, -0.2f, 1, 1, -0.2f, 1.4f, 1, 0.2f, 1.4f},
      uvs{0, 0, 1, 0, 1, 1, 0, 1};
  std::vector<uint32_t> indices{0, 1, 2, 0, 2, 3};
  rg_pane_info info;
  explicit Pane(const rg_api& api) {
    api.default_pane_info(&info);
    info.vehicle = kCar;
    info.vertex_count = 4;
    info.index_count = 6;
    info.texel_m = 20e-3;
    info.name = "spoilt";
  }
  const rg_pane_info* get() {
    info.positions_m = positions.empty() ? nullptr : positions.data();
    info.uvs = uvs.empty() ? nullptr : uvs.data();
    info.indices = indices.empty() ? nullptr : indices.data();
    return &info;
  }
};

TEST_F(BadObjects, panesThatAreNoPanes) {
  const auto refused = [&](const std::string& what, const std::string& field,
                           const std::function<void(Pane&)>& spoil, rg_result code = RG_ERROR_BAD_ARGUMENT) {
    Pane pane(api);
    spoil(pane);
    expectRefused(
        what, [&] { return api.set_pane(scene.instance, kPane, pane.get()); }, code, field);
  };
  refused("vehicle 0", "vehicle", [](Pane& p) { p.info.vehicle = 0; });
  refused("no uvs", "'spoilt': rg_pane_info.uvs", [](Pane& p) { p.uvs.clear(); });
  refused("no uvs of a pane without a name", "'1': rg_pane_info.uvs", [](Pane& p) {
    p.uvs.clear();
    p.info.name = nullptr;
  });
  refused("no positions", "'spoilt': rg_pane_info.positions_m", [](Pane& p) { p.positions.clear(); });
  refused("no indices", "'spoilt': rg_pane_info.indices", [](Pane& p) { p.indices.clear(); });
  refused("no triangles", "spoilt", [](Pane& p) { p.info.index_count = 0; });
  refused("no vertices", "spoilt", [](Pane& p) { p.info.vertex_count = 0; });
  refused("four indices", "index_count", [](Pane& p) { p.info.index_count = 4; });
  refused("an index past the vertices", "index 4", [](Pane& p) { p.indices[5] = 4; });
  refused("an index far past the vertices", "index 4294967295", [](Pane& p) { p.indices[0] = 0xFFFFFFFF; });
  refused("huge counts", "positions_m", [](Pane& p) { p.info.vertex_count = 0xFFFFFFFF; });
  refused("huge index count", "indices", [](Pane& p) { p.info.index_count = 0xFFFFFFFF; });
  refused("a position that is no number", "positions_m[1]",
          [](Pane& p) { p.positions[4] = static_cast<float>(kNaN); });
  refused("a uv that is no number", "uvs[3]", [](Pane& p) { p.uvs[7] = static_cast<float>(kInfinity); });
  refused("no area", "spoilt", [](Pane& p) { p.positions.assign(12, 1.0f); });
  refused("a triangle without area", "'spoilt': triangle 1 has no area",
          [](Pane& p) { p.indices = {0, 1, 2, 0, 2, 2}; });
  refused("uvs without area", "'spoilt': its uvs", [](Pane& p) { p.uvs.assign(8, 0.5f); });
  refused("a triangle without area in uv", "'spoilt': triangle 1 has no area in uv",
          [](Pane& p) { p.uvs[6] = p.uvs[7] = 0.5f; });
  refused("overlapping uvs", "spoilt", [](Pane& p) {
    p.positions.insert(p.positions.end(), {2, 0.2f, 1, 2, -0.2f, 1, 2, -0.2f, 1.4f});
    p.uvs.insert(p.uvs.end(), {0, 0, 1, 0, 1, 1});
    p.indices = {0, 1, 2, 4, 5, 6};
    p.info.vertex_count = 7;
  });
  refused("as large as a town", "texels", [](Pane& p) {
    for (float& x : p.positions) x *= 1000.0f;
  });
  refused("as large as the sky", "spoilt", [](Pane& p) {
    for (float& x : p.positions) x *= 1e30f;
  });
  refused(
      "a stride of 2", "positions_m", [](Pane& p) { p.info.position_stride = 2; }, RG_ERROR_BAD_STRUCT);
  refused(
      "a stride between floats", "uvs", [](Pane& p) { p.info.uv_stride = 10; }, RG_ERROR_BAD_STRUCT);
  refused(
      "a stride without end", "uvs", [](Pane& p) { p.info.uv_stride = SIZE_MAX; }, RG_ERROR_BAD_STRUCT);
  refused("an unknown glass", "rg_pane_info.glass", [](Pane& p) { p.info.glass = 99; });
  refused("texels too small", "texel_m", [](Pane& p) { p.info.texel_m = 1e-6; });
  refused("an angle past a half turn", "advancing_deg", [](Pane& p) { p.info.advancing_deg = 181.0; });
  refused("a negative angle", "receding_deg", [](Pane& p) { p.info.receding_deg = -1.0; });
  refused("more drops than can be", "max_drops", [](Pane& p) { p.info.max_drops = 0xFFFFFFFF; });
  refused("a window open above its frame", "opening_m", [](Pane& p) { p.info.opening_m = -0.1; });
  refused("a slide of no length", "slide_direction", [](Pane& p) { p.info.slide_direction[2] = -0.1; });
  refused("a slide through the glass", "spoilt", [](Pane& p) { p.info.slide_direction[0] = 1.0; });
  refused("a sill of no length", "sill", [](Pane& p) { p.info.sill[2] = -0.1; });
  refused("a sill at no place", "sill", [](Pane& p) { p.info.sill[2] = -1.0, p.info.sill[3] = kNaN; });
  refused("a sill along the way", "spoilt", [](Pane& p) { p.info.sill[1] = 1.0; });
  refused("more than all of the demister", "rg_pane_info.demister", [](Pane& p) { p.info.demister = 1.5; });
  refused("a demister of no number", "rg_pane_info.demister", [](Pane& p) { p.info.demister = kNaN; });
  refused("a mirror that shines", "rg_pane_info.mirror", [](Pane& p) { p.info.mirror = 1.1; });
  refused("a mirror of no number", "rg_pane_info.mirror", [](Pane& p) { p.info.mirror = kNaN; });
  refused("a window open by no number", "opening_m", [](Pane& p) { p.info.opening_m = kNaN; });
  expectStructChecked<rg_pane_info>("rg_pane_info", *Pane(api).get(),
                                    {offsetof(rg_pane_info, advancing_deg),
                                     offsetof(rg_pane_info, receding_deg), offsetof(rg_pane_info, texel_m)},
                                    [&](const rg_pane_info& info) {
                                      Pane pane(api);
                                      pane.info = info;
                                      return api.set_pane(scene.instance, kPane, pane.get());
                                    });
  Pane good(api);
  expectRefused(
      "id 0", [&] { return api.set_pane(scene.instance, 0, good.get()); }, RG_ERROR_BAD_ARGUMENT, "pane id");
  EXPECT_EQ(api.set_pane(scene.instance, 2, good.get()), RG_OK) << api.last_error(scene.instance);
}

// Whatever numbers a mesh has, it is taken or refused; refused it changes nothing.
TEST_F(BadObjects, meshesOfNonsense) {
  std::mt19937 random(1);
  const std::array<float, 9> nasty{0.0f,
                                   -1.0f,
                                   1e-30f,
                                   1e30f,
                                   -3e38f,
                                   1e-6f,
                                   100.0f,
                                   static_cast<float>(kNaN),
                                   static_cast<float>(-kInfinity)};
  int refused = 0;
  for (int round = 0; round < 30; ++round) {
    Pane pane(api);
    for (int i = 0; i < 2; ++i) {
      std::vector<float>& numbers = random() % 2 == 0 ? pane.positions : pane.uvs;
      numbers[random() % numbers.size()] = nasty[random() % nasty.size()];
    }
    const uint64_t before = stateHash();
    const rg_result result = api.set_pane(scene.instance, 3, pane.get());
    if (result == RG_OK) {
      EXPECT_EQ(api.remove_pane(scene.instance, 3), RG_OK);
    } else {
      ++refused;
      EXPECT_EQ(result, RG_ERROR_BAD_ARGUMENT) << api.last_error(scene.instance);
    }
    EXPECT_EQ(stateHash(), before) << "round " << round;
  }
  EXPECT_GT(refused, 7) << "hardly any nonsense was tried";
}

TEST_F(BadObjects, wipersThatCannotTurn) {
  rg_wiper_info good;
  api.default_wiper_info(&good);
  good.pane = kPane;
  const auto refused = [&](const std::string& what, const std::string& field,
                           const std::function<void(rg_wiper_info&)>& spoil,
                           rg_result code = RG_ERROR_BAD_ARGUMENT) {
    rg_wiper_info wiper = good;
    spoil(wiper);
    expectRefused(
        what, [&] { return api.set_wiper(scene.instance, kWiper, &wiper); }, code, field);
  };
  refused(
      "an unknown pane", "pane 77", [](rg_wiper_info& w) { w.pane = 77; }, RG_ERROR_NOT_FOUND);
  refused("no axis", "axis", [](rg_wiper_info& w) { w.axis[2] = 0.0; });
  refused("no rest direction", "rest_direction", [](rg_wiper_info& w) { w.rest_direction[0] = 0.0; });
  refused("a rest direction along the axis", "rest_direction",
          [](rg_wiper_info& w) { w.rest_direction[0] = 0.0, w.rest_direction[2] = 1.0; });
  refused("no arm", "arm_m", [](rg_wiper_info& w) { w.arm_m = 0.0; });
  refused("no blade", "blade_m", [](rg_wiper_info& w) { w.blade_m = 0.0; });
  refused("a blade more than worn", "wear", [](rg_wiper_info& w) { w.wear = 1.5; });
  refused("a whirling blade", "blade_turn", [](rg_wiper_info& w) { w.blade_turn = 3.0; });
  refused("a blade without lift", "lift_m", [](rg_wiper_info& w) { w.lift_m = 0.0; });
  refused("a flooding blade", "residual_film_m", [](rg_wiper_info& w) { w.residual_film_m = 1.0; });
  expectStructChecked<rg_wiper_info>(
      "rg_wiper_info", good,
      {offsetof(rg_wiper_info, pivot_m), offsetof(rg_wiper_info, axis) + 8,
       offsetof(rg_wiper_info, rest_direction) + 16, offsetof(rg_wiper_info, arm_m),
       offsetof(rg_wiper_info, blade_m), offsetof(rg_wiper_info, blade_angle_rad),
       offsetof(rg_wiper_info, residual_film_m), offsetof(rg_wiper_info, blade_turn),
       offsetof(rg_wiper_info, wear), offsetof(rg_wiper_info, lift_m)},
      [&](const rg_wiper_info& w) { return api.set_wiper(scene.instance, kWiper, &w); });
  expectRefused(
      "id 0", [&] { return api.set_wiper(scene.instance, 0, &good); }, RG_ERROR_BAD_ARGUMENT, "wiper id");
  for (uint32_t id = 10; id < 17; ++id) ASSERT_EQ(api.set_wiper(scene.instance, id, &good), RG_OK);
  expectRefused(
      "a ninth wiper", [&] { return api.set_wiper(scene.instance, 20, &good); }, RG_ERROR_BAD_ARGUMENT,
      "8 wipers");
  Pane other(api);
  ASSERT_EQ(api.set_pane(scene.instance, 2, other.get()), RG_OK);
  good.pane = 2;
  ASSERT_EQ(api.set_wiper(scene.instance, 30, &good), RG_OK);
  good.pane = kPane;
  expectRefused(
      "a wiper that moves to a full pane", [&] { return api.set_wiper(scene.instance, 30, &good); },
      RG_ERROR_BAD_ARGUMENT, "8 wipers");
  EXPECT_EQ(api.remove_wiper(scene.instance, 30), RG_OK) << "it is not where it was";
}

TEST_F(BadObjects, dropsThatCannotSit) {
  const auto refused = [&](const std::string& what, const std::string& field, const rg_glass_drop& bad) {
    const std::array<rg_glass_drop, 2> drops{rg_glass_drop{0.0, 0.0, 1e-3, 40.0}, bad};
    expectRefused(
        what, [&] { return api.place_drops(scene.instance, kPane, drops.data(), 2); }, RG_ERROR_BAD_ARGUMENT,
        field);
  };
  refused("off the pane", "off the pane", {5.0, 0.0, 1e-3, 40.0});
  refused("no number", "u_m", {kNaN, 0.0, 1e-3, 40.0});
  refused("no number", "v_m", {0.0, -kInfinity, 1e-3, 40.0});
  refused("no radius", "base_radius_m", {0.0, 0.0, 0.0, 40.0});
  refused("no number", "base_radius_m", {0.0, 0.0, kNaN, 40.0});
  refused("a full turn", "contact_angle_deg", {0.0, 0.0, 1e-3, 360.0});
  const rg_glass_drop good{0.0, 0.0, 1e-3, 40.0};
  expectRefused(
      "a huge count", [&] { return api.place_drops(scene.instance, kPane, &good, 0xFFFFFFFF); },
      RG_ERROR_BAD_ARGUMENT, "drops");
  expectRefused(
      "a count without drops", [&] { return api.place_drops(scene.instance, kPane, nullptr, 1); },
      RG_ERROR_BAD_ARGUMENT, "drops");
  expectRefused(
      "an unknown pane", [&] { return api.place_drops(scene.instance, 77, &good, 1); }, RG_ERROR_NOT_FOUND,
      "pane 77");
}

TEST_F(BadObjects, idsThatAreUnknown) {
  rg_instance* const i = scene.instance;
  expectRefused(
      "volume", [&] { return api.remove_volume(i, 77); }, RG_ERROR_NOT_FOUND, "volume 77");
  expectRefused(
      "pane", [&] { return api.remove_pane(i, 77); }, RG_ERROR_NOT_FOUND, "pane 77");
  expectRefused(
      "wiper", [&] { return api.remove_wiper(i, 77); }, RG_ERROR_NOT_FOUND, "wiper 77");
  expectRefused(
      "vehicle", [&] { return api.remove_vehicle(i, 77); }, RG_ERROR_NOT_FOUND, "vehicle 77");
  expectRefused(
      "vehicle", [&] { return api.remove_vehicle(i, 0); }, RG_ERROR_BAD_ARGUMENT, "vehicle id");
  rg_pane_stats stats{};
  stats.struct_size = sizeof stats;
  expectRefused(
      "stats", [&] { return api.get_pane_stats(i, 77, &stats); }, RG_ERROR_NOT_FOUND, "pane 77");
  rg_parameter parameter{};
  parameter.struct_size = sizeof parameter;
  expectRefused(
      "parameter", [&] { return api.get_parameter(i, 1000, &parameter); }, RG_ERROR_NOT_FOUND,
      "parameter 1000");
  uint64_t hash = 0;
  expectRefused(
      "hash", [&] { return api.get_hash(i, 7, &hash); }, RG_ERROR_BAD_ARGUMENT, "kind");
}

TEST_F(BadObjects, rainPatternsThatCannotBe) {
  const std::vector<uint8_t> grey(size_t{4} * 16 * 16, 128), dry(grey.size(), 0);
  rg_rain_pattern good;
  api.default_rain_pattern(&good);
  good.width_px = good.height_px = 16;
  good.rgba = grey.data();
  const auto call = [&](const rg_rain_pattern& p) { return api.set_rain_pattern(scene.instance, &p); };
  expectStructChecked<rg_rain_pattern>("rg_rain_pattern", good, {}, call);
  const auto refused = [&](const std::string& field, const std::function<void(rg_rain_pattern&)>& spoil) {
    rg_rain_pattern bad = good;
    spoil(bad);
    expectRefused(
        field, [&] { return call(bad); }, RG_ERROR_BAD_ARGUMENT, field);
  };
  refused("width_px", [](rg_rain_pattern& p) { p.width_px = 0; });
  refused("width_px", [](rg_rain_pattern& p) { p.width_px = 0xFFFFFFFF; });
  refused("height_px", [](rg_rain_pattern& p) { p.height_px = 7; });
  refused("height_px", [](rg_rain_pattern& p) { p.height_px = 4097; });
  refused("rgba", [](rg_rain_pattern& p) { p.rgba = nullptr; });
  refused("row_stride_bytes", [](rg_rain_pattern& p) { p.row_stride_bytes = 63; });
  refused("row_stride_bytes", [](rg_rain_pattern& p) { p.row_stride_bytes = SIZE_MAX; });
  refused("alpha", [&](rg_rain_pattern& p) { p.rgba = dry.data(); });
}

TEST_F(BadObjects, aRainPatternIsTakenWithOrWithoutStrideAndTakenBack) {
  const std::vector<uint8_t> grey(size_t{80} * 16, 128);
  rg_rain_pattern pattern;
  api.default_rain_pattern(&pattern);
  pattern.width_px = pattern.height_px = 16;
  pattern.rgba = grey.data();
  for (const size_t stride : {size_t{0}, size_t{64}, size_t{80}}) {
    pattern.row_stride_bytes = stride;
    EXPECT_EQ(api.set_rain_pattern(scene.instance, &pattern), RG_OK) << api.last_error(scene.instance);
    EXPECT_EQ(api.step_gpu(scene.instance), RG_OK) << api.last_error(scene.instance);
  }
  EXPECT_EQ(api.set_rain_pattern(scene.instance, nullptr), RG_OK) << api.last_error(scene.instance);
  EXPECT_EQ(api.step_gpu(scene.instance), RG_OK) << api.last_error(scene.instance);
}

}  // namespace
}  // namespace rg::test
