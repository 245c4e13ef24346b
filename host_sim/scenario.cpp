#include "scenario.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace host {
namespace {

constexpr double kKmh = 1.0 / 3.6;
constexpr size_t kMostTraffic = 32;  // each is drawn whole
constexpr double kWidestOpening_m = 1.0;

// Reads a table key by key; finish() refuses what nobody asked for.
class Reader {
 public:
  Reader(const toml::table* table, std::string where) : table_(table), where_(std::move(where)) {}

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    throw InputError(where_ + key + ": " + why);
  }

  double number(const char* key, double preset, double least, double most) {
    const toml::node* node = find(key);
    if (node == nullptr) return preset;
    const auto value = node->value<double>();
    if (!value) refuse(key, "must be a number");
    return checked(key, *value, least, most);
  }
  std::string text(const char* key, const std::string& preset) {
    const toml::node* node = find(key);
    if (node == nullptr) return preset;
    const auto value = node->value<std::string>();
    if (!value) refuse(key, "must be a string");
    return *value;
  }
  bool flag(const char* key, bool preset) {
    const toml::node* node = find(key);
    if (node == nullptr) return preset;
    const auto value = node->value<bool>();
    if (!value) refuse(key, "must be true or false");
    return *value;
  }
  // A number, or [[at, value], ...] ascending in `at`.
  Curve curve(const char* key, double preset, double least, double most, double unit = 1.0) {
    const toml::node* node = find(key);
    if (node == nullptr) return Curve(preset);
    if (node->is_number()) return Curve(checked(key, *node->value<double>(), least, most) * unit);
    std::vector<CurvePoint> points;
    for (const auto& [at, value] : pairs(key, *node)) {
      const auto v = value->value<double>();
      if (!v) refuse(key, "has a value that is not a number");
      points.push_back({at, checked(key, *v, least, most) * unit});
    }
    return Curve(points);
  }
  std::vector<std::pair<double, const toml::node*>> pairs(const char* key, const toml::node& node) const {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->empty()) refuse(key, "must be a value or a list of [at, value]");
    std::vector<std::pair<double, const toml::node*>> result;
    for (const toml::node& item : *list) {
      const toml::array* pair = item.as_array();
      if (pair == nullptr || pair->size() != 2 || !pair->get(0)->is_number())
        refuse(key, "must be a list of [at, value]");
      const double at = *pair->get(0)->value<double>();
      if (!std::isfinite(at) || (!result.empty() && at <= result.back().first)) refuse(key, "must ascend");
      result.emplace_back(at, pair->get(1));
    }
    return result;
  }
  const toml::node* find(const char* key) {
    asked_.insert(key);
    return table_ == nullptr ? nullptr : table_->get(key);
  }
  Reader section(const char* key) {
    const toml::node* node = find(key);
    if (node != nullptr && !node->is_table()) refuse(key, "must be a table");
    return Reader(node == nullptr ? nullptr : node->as_table(), where_ + key + ".");
  }
  const toml::table* table() const { return table_; }
  void finish() const {
    if (table_ == nullptr) return;
    for (const auto& [key, value] : *table_) {
      if (!asked_.contains(std::string(key.str())))
        refuse(std::string(key.str()), "is not a key of a scenario");
    }
  }

 private:
  double checked(const char* key, double value, double least, double most) const {
    if (value >= least && value <= most) return value;
    std::ostringstream why;
    why << "is " << value << ", must be " << least << " .. " << most;
    refuse(key, why.str());
  }

  const toml::table* table_;
  std::string where_;
  std::set<std::string, std::less<>> asked_;
};

void readDrive(Reader drive, DrivePlan& plan) {
  plan.start_m = drive.number("start_m", 0.0, 0.0, 1e6);
  plan.speed_mps = drive.curve("speed_kmh", 0.0, 0.0, 210.0, kKmh);
  if (const toml::node* stops = drive.find("stops")) {
    for (const auto& [at, seconds] : drive.pairs("stops", *stops)) {
      const auto value = seconds->value<double>();
      if (!value || !(*value >= 0.0 && *value <= 3600.0))
        drive.refuse("stops", "must be a list of [way in m, seconds]");
      plan.stops.push_back({at, *value});
    }
  }
  drive.finish();
}

void readTraffic(Reader& top, Scenario& s) {
  const toml::node* node = top.find("traffic");
  if (node == nullptr) return;
  if (!node->is_array()) top.refuse("traffic", "must be a list of [way in m, km/h]");
  for (const toml::node& item : *node->as_array()) {
    const toml::array* pair = item.as_array();
    const bool numbers =
        pair != nullptr && pair->size() == 2 && pair->get(0)->is_number() && pair->get(1)->is_number();
    if (!numbers) top.refuse("traffic", "must be a list of [way in m, km/h]");
    const double way_m = *pair->get(0)->value<double>(), speed_kmh = *pair->get(1)->value<double>();
    if (!(std::abs(way_m) <= 1e6)) top.refuse("traffic", "has a way that is not within 1e6 m");
    if (!(std::abs(speed_kmh) <= 210.0)) top.refuse("traffic", "has a speed that is not -210 .. 210 km/h");
    s.traffic.push_back({way_m, speed_kmh * kKmh});
  }
  if (s.traffic.size() > kMostTraffic)
    top.refuse("traffic", "has more than " + std::to_string(kMostTraffic) + " cars");
}

void readWeather(Reader weather, Scenario& s) {
  s.rain_mm_h = weather.curve("rain_mm_h", 0.0, 0.0, 300.0);
  s.snow_mm_h = weather.curve("snow_mm_h", 0.0, 0.0, 300.0);
  s.hail_mm_h = weather.curve("hail_mm_h", 0.0, 0.0, 300.0);
  s.wind_x_mps = weather.curve("wind_x_mps", 0.0, -100.0, 100.0);
  s.wind_y_mps = weather.curve("wind_y_mps", 0.0, -100.0, 100.0);
  s.temperature_c = weather.curve("temperature_c", 12.0, -60.0, 60.0);
  s.humidity = weather.curve("humidity", 0.9, 0.0, 1.0);
  s.visibility_m = weather.curve("visibility_m", 20000.0, 10.0, 1e6);
  s.sun_elevation_deg = weather.number("sun_elevation_deg", 35.0, -20.0, 90.0);
  s.sun_azimuth_deg = weather.number("sun_azimuth_deg", 140.0, -360.0, 360.0);
  weather.finish();
}

void readWipers(Reader& top, Scenario& s) {
  const toml::node* node = top.find("wipers");
  if (node == nullptr) return;
  const auto mode = [&](const toml::node& value) {
    const auto text = value.value<std::string>();
    try {
      return wiperModeFrom(text ? *text : value.is_integer() ? std::to_string(*value.value<int64_t>()) : "");
    } catch (const std::invalid_argument& e) {
      top.refuse("wipers", e.what());
    }
  };
  if (!node->is_array())
    s.wipers = {{0.0, mode(*node)}};
  else
    for (const auto& [at, value] : top.pairs("wipers", *node)) s.wipers.push_back({at, mode(*value)});
}

void readWashes(Reader& top, Scenario& s) {
  const toml::node* node = top.find("washes");
  if (node == nullptr) return;
  if (!node->is_array()) top.refuse("washes", "must be a list of seconds");
  for (const toml::node& at : *node->as_array()) {
    const auto second = at.value<double>();
    if (!second || !(*second >= 0.0) || *second > 36000.0)
      top.refuse("washes", "must be seconds, 0 .. 36000");
    s.washes.push_back(*second);
  }
}

void readDemister(Reader& top, Scenario& s) {
  const toml::node* node = top.find("demister");
  if (node == nullptr) return;
  const auto share = [&](const toml::node& value) {
    const auto number = value.value<double>();
    if (!number || !(*number >= 0.0 && *number <= 1.0)) top.refuse("demister", "must be a share, 0 .. 1");
    return *number;
  };
  if (!node->is_array()) {
    s.demister = {{0.0, share(*node)}};
    return;
  }
  for (const auto& [at, value] : top.pairs("demister", *node)) s.demister.emplace_back(at, share(*value));
}

// Which panes there are the car knows.
void readWindows(Reader windows, Scenario& s) {
  if (windows.table() == nullptr) return;
  for (const auto& [key, value] : *windows.table()) {
    const std::string pane(key.str());
    s.windows.emplace_back(pane, windows.curve(pane.c_str(), 0.0, 0.0, kWidestOpening_m));
  }
}

void readParameters(Reader& top, Scenario& s) {
  const Reader section = top.section("plugin");
  if (section.table() == nullptr) return;
  const auto walk = [&](auto&& self, const toml::table& table, const std::string& prefix) -> void {
    for (const auto& [key, value] : table) {
      const std::string name = prefix + std::string(key.str());
      const toml::node& node = value;
      if (node.is_table())
        self(self, *node.as_table(), name + ".");
      else if (const auto number = node.value<double>())
        s.parameters.emplace_back(name, *number);
      else
        section.refuse(name, "must be a number");
    }
  };
  walk(walk, *section.table(), "");
}

void readGlass(Reader& top, Scenario& s) {
  if (top.find("glass") == nullptr) return;
  const std::string name = top.text("glass", "");
  const auto found =
      std::ranges::find_if(kGlassSurfaces, [&](const auto& surface) { return name == surface.first; });
  if (found == kGlassSurfaces.end())
    top.refuse("glass", "\"" + name + "\" is none of uncoated, dirty, coated, new_coating");
  s.glass = found->second;
}

std::filesystem::path modelPath(const std::string& text, const std::filesystem::path& root) {
  if (text.empty()) return {};
  const std::filesystem::path path(text);
  return path.is_absolute() ? path : root / path;
}

toml::table parseFile(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(file.string() + ": no such scenario file");
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& e) {
    std::ostringstream line;
    line << file.string() << ":" << e.source().begin.line << ": " << e.description();
    throw InputError(line.str());
  }
}

// "weather.rain_mm_h=20" changes that key, making tables on the way.
void applyChange(toml::table& top, const std::string& change) {
  const auto equals = change.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError("--set " + change + ": must be path.to.key=value");
  const std::string path = change.substr(0, equals), value = change.substr(equals + 1);
  toml::table parsed;
  try {
    parsed = toml::parse("v = " + value);
  } catch (const toml::parse_error&) {
    parsed.insert_or_assign("v", value);
  }
  toml::table* table = &top;
  size_t begin = 0;
  for (size_t dot = path.find('.'); dot != std::string::npos; begin = dot + 1, dot = path.find('.', begin)) {
    const std::string key = path.substr(begin, dot - begin);
    if (key.empty()) throw InputError("--set " + change + ": has an empty key");
    if (!table->contains(key)) table->insert(key, toml::table{});
    table = table->get(key)->as_table();
    if (table == nullptr) throw InputError("--set " + change + ": " + key + " is not a table");
  }
  if (begin >= path.size()) throw InputError("--set " + change + ": has an empty key");
  parsed.get("v")->visit([&](auto& node) { table->insert_or_assign(path.substr(begin), std::move(node)); });
}

}  // namespace

Scenario loadScenario(const std::string& name_or_file, const std::vector<std::string>& changes,
                      const std::filesystem::path& root) {
  const bool is_file = name_or_file.ends_with(".toml") || name_or_file.find('/') != std::string::npos;
  const std::filesystem::path file =
      is_file ? std::filesystem::path(name_or_file) : root / "scenarios" / (name_or_file + ".toml");
  toml::table table = parseFile(file);
  for (const std::string& change : changes) applyChange(table, change);

  Reader top(&table, file.string() + ": ");
  Scenario s;
  s.name = file.stem().string();
  s.title = top.text("title", s.name);
  s.seconds = top.number("seconds", 60.0, 0.0, 36000.0);
  s.prewarm_s = top.number("prewarm_s", 0.0, 0.0, 600.0);
  s.seed = static_cast<uint64_t>(top.number("seed", 1.0, 0.0, 9e15));
  s.camera = top.text("camera", "cockpit");
  if (top.find("white_cd_m2") != nullptr) s.white_cd_m2 = top.number("white_cd_m2", 0.0, 1e-3, 1e9);
  readGlass(top, s);
  s.headlights = top.flag("headlights", true);
  s.shelter = top.flag("shelter", true);
  Reader models = top.section("models");
  s.car = modelPath(models.text("car", "models/car.glb"), root);
  s.road = modelPath(models.text("road", "models/road.glb"), root);
  models.finish();
  readDrive(top.section("drive"), s.plan);
  readWeather(top.section("weather"), s);
  readTraffic(top, s);
  readWipers(top, s);
  s.wiper_pause_s = top.number("wiper_pause_s", kIntermittentPause_s, 0.5, 60.0);
  readWashes(top, s);
  readDemister(top, s);
  readWindows(top.section("windows"), s);
  readParameters(top, s);
  top.finish();
  return s;
}

WiperMode wiperModeAt(const Scenario& scenario, double time_s) {
  WiperMode mode = WiperMode::off;
  for (const WiperSwitch& w : scenario.wipers) {
    if (time_s >= w.at_s) mode = w.mode;
  }
  return mode;
}

}  // namespace host
