#include "overlay/overlay.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <string_view>
#include <tuple>

#include "stage.h"
#include "window/pilot.h"

namespace host {
namespace {

constexpr double kGreeting_s = 10.0;
constexpr double kSlowEvery_s = 0.5;
constexpr float kLetter_px = 13.0F;  // what ImGui's own font is drawn for
constexpr float kMargin_px = 12.0F;
constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing;
constexpr ImGuiSliderFlags kSlider = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
constexpr double kWideRange = 50.0;  // from here on a slider goes by ratio

void setStyle(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 6.0F;
  style.FrameRounding = style.GrabRounding = 3.0F;
  style.WindowBorderSize = 0.0F;
  style.Colors[ImGuiCol_WindowBg] = {0.04F, 0.06F, 0.08F, 0.72F};
  style.Colors[ImGuiCol_FrameBg] = {0.20F, 0.26F, 0.32F, 0.60F};
  style.Colors[ImGuiCol_Header] = {0.20F, 0.30F, 0.38F, 0.60F};
  style.ScaleAllSizes(scale);
}

// A panel in an upper corner, no larger than the window. `side`: 0 left, 1 right.
void beginPanel(const char* name, float side) {
  const ImVec2 all = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({side > 0.0F ? all.x - kMargin_px : kMargin_px, kMargin_px}, ImGuiCond_Always,
                          {side, 0.0F});
  const ImVec2 most(std::max(all.x - 2.0F * kMargin_px, 1.0F), std::max(all.y - 2.0F * kMargin_px, 1.0F));
  ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, most);
  ImGui::Begin(name, nullptr, kPanel);
}

bool beginTable(const char* name, int columns) {
  return ImGui::BeginTable(name, columns, ImGuiTableFlags_SizingFixedFit);
}

[[gnu::format(printf, 1, 2)]] void cell(const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  ImGui::TableNextColumn();
  ImGui::TextV(format, values);
  va_end(values);
}

[[gnu::format(printf, 2, 3)]] void row(const char* name, const char* format, ...) {
  cell("%s", name);
  std::va_list values;
  va_start(values, format);
  ImGui::TableNextColumn();
  ImGui::TextV(format, values);
  va_end(values);
}

bool slider(const char* name, double& value, double least, double most, const char* format,
            ImGuiSliderFlags flags = 0) {
  return ImGui::SliderScalar(name, ImGuiDataType_Double, &value, &least, &most, format, kSlider | flags);
}

// "%.4g mm": a unit is text, a percent sign in it none of the format's.
std::string formatWith(const char* unit) {
  std::string format = "%.4g";
  if (std::string_view(unit) == "1" || *unit == '\0') return format;
  format += ' ';
  for (const char* c = unit; *c != '\0'; ++c) format += *c == '%' ? "%%" : std::string(1, *c);
  return format;
}

void windRow(Simulation& sim) {
  const glm::dvec2 from = windByCar(sim);
  const double degrees = glm::degrees(std::atan2(from.y, from.x));
  const double speed_mps = glm::length(from);
  if (speed_mps < 0.05) return row("wind", "%s", "none");
  row("wind", "%.1f m/s from %.0f deg %s", speed_mps, std::abs(degrees), degrees < 0.0 ? "right" : "left");
}

void wiperChoice(Overrides& overrides) {
  const auto choice = [&](const char* name, std::optional<WiperMode> mode) {
    if (ImGui::RadioButton(name, overrides.wipers == mode)) overrides.wipers = mode;
  };
  ImGui::TextUnformatted("wipers");
  choice("scenario", std::nullopt);
  ImGui::SameLine();
  choice("off", WiperMode::off);
  ImGui::SameLine();
  choice("intermittent", WiperMode::intermittent);
  ImGui::SameLine();
  choice("automatic", WiperMode::automatic);
  ImGui::SameLine();
  choice("slow", WiperMode::slow);
  ImGui::SameLine();
  choice("fast", WiperMode::fast);
}

bool parameterSlider(rg_parameter& p) {
  const bool wide = p.minimum > 0.0 && p.maximum / p.minimum >= kWideRange;
  bool changed = slider(p.name, p.value, p.minimum, p.maximum, formatWith(p.unit).c_str(),
                        wide ? ImGuiSliderFlags_Logarithmic : 0);
  if (!ImGui::IsItemHovered()) return changed;
  ImGui::SetTooltip("%s\npreset %g; double click sets it", p.text, p.preset);
  if (!ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return changed;
  p.value = p.preset;
  return true;
}

}  // namespace

void Overlay::DestroyImgui::operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }

Overlay::Overlay(const Context& context, float text_scale)
    : imgui_(ImGui::CreateContext()), greeting_left_s_(kGreeting_s) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is kept from run to run
  const float scale = std::clamp(text_scale, 1.0F, 4.0F);
  ImFontConfig font;
  font.SizePixels = kLetter_px * scale;
  io.Fonts->AddFontDefault(&font);
  setStyle(scale);
  painter_ = std::make_unique<ImguiGl>(context);
}

Overlay::~Overlay() = default;

void Overlay::toggle() { shown_ = shown_ == Shown::all ? Shown::nothing : Shown::all; }
bool Overlay::wantsMouse() const { return shown_ != Shown::nothing && ImGui::GetIO().WantCaptureMouse; }
void Overlay::moveCursor(glm::dvec2 at_px) {
  ImGui::GetIO().MousePos = {static_cast<float>(at_px.x), static_cast<float>(at_px.y)};
}
void Overlay::pressButton(bool down) { ImGui::GetIO().MouseDown[0] = down; }
void Overlay::scroll(double steps) { ImGui::GetIO().MouseWheel += static_cast<float>(steps); }

void Overlay::refresh(Stage& stage, double seconds) {
  slow_age_s_ += seconds;
  if (slow_age_s_ < kSlowEvery_s) return;
  slow_age_s_ = 0.0;
  slow_.stages = stage.plugin().stages();
  slow_.parameters = stage.plugin().parameters();
  const auto panes = stage.plugin().paneStats();
  if (panes.empty()) return;
  const auto screen = std::ranges::find_if(
      panes, [](const auto& p) { return p.first.find("windscreen") != std::string::npos; });
  std::tie(slow_.pane, slow_.water) = screen == panes.end() ? panes.front() : *screen;
}

void Overlay::draw(Stage& stage, glm::ivec2 size_px, double seconds, double fps, const char* note) {
  if (*note == '\0') greeting_left_s_ -= std::min(seconds, kSlowEvery_s);  // a slow picture is no long look
  if (shown_ == Shown::greeting && greeting_left_s_ < 0.0) shown_ = Shown::nothing;
  if (shown_ == Shown::nothing && *note == '\0') return;
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size_px.x), static_cast<float>(size_px.y)};
  io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
  const bool all = shown_ == Shown::all;
  if (all) refresh(stage, seconds);
  ImGui::NewFrame();
  beginPanel("status", 0.0F);
  drawStatus(stage, fps, note);
  if (shown_ != Shown::nothing) drawKeys();
  if (all) drawWater();
  if (all) drawStages();
  ImGui::End();
  if (all) {
    beginPanel("sliders", 1.0F);
    ImGui::PushItemWidth(ImGui::GetFontSize() * 14.0F);
    drawWeather(stage);
    drawParameters(stage);
    ImGui::PopItemWidth();
    ImGui::End();
  }
  ImGui::Render();
  painter_->draw(*ImGui::GetDrawData(), 0);
}

void Overlay::drawStatus(Stage& stage, double fps, const char* note) const {
  Simulation& sim = stage.simulation();
  if (*note != '\0') {
    ImGui::PushTextWrapPos(ImGui::GetIO().DisplaySize.x - 4.0F * kMargin_px);
    ImGui::TextColored({1.0F, 0.8F, 0.4F, 1.0F}, "%s", note);
    ImGui::PopTextWrapPos();
  }
  if (!beginTable("status", 2)) return;
  row("speed", "%.0f km/h%s", sim.driver().state().speed_mps * 3.6,
      sim.overrides.controls ? ", by hand" : "");
  const Weather now = sim.weather();
  row("rain", "%.1f mm/h", now.rain_mm_h);
  if (now.snow_mm_h > 0.0) row("snow", "%.1f mm/h as water", now.snow_mm_h);
  if (now.hail_mm_h > 0.0) row("hail", "%.1f mm/h as water", now.hail_mm_h);
  windRow(sim);
  row("wipers", "%s", wiperModeName(sim.wiperMode()));
  row("camera", "%s", sim.camera.c_str());
  row("pictures", "%.1f a second", fps);
  ImGui::EndTable();
}

void Overlay::drawKeys() const {
  if (!ImGui::CollapsingHeader("keys", ImGuiTreeNodeFlags_DefaultOpen) || !beginTable("keys", 2)) return;
  for (const KeyHelp& help : kKeyHelp) {
    row(help.keys, "%s", help.effect);
  }
  ImGui::EndTable();
}

void Overlay::drawWater() const {
  if (slow_.pane.empty() ||
      !ImGui::CollapsingHeader(("water on " + slow_.pane).c_str(), ImGuiTreeNodeFlags_DefaultOpen))
    return;
  if (!beginTable("water", 4)) return;
  const rg_pane_stats& w = slow_.water;
  row("caught", "%.1f mL ", w.caught_ml);
  row("on the glass", "%.1f mL", w.on_glass_ml);
  row("drained", "%.1f mL ", w.drained_ml);
  row("wiped off", "%.1f mL", w.wiped_ml);
  row("blown off", "%.1f mL ", w.blown_ml);
  row("evaporated", "%.1f mL", w.evaporated_ml);
  row("drops", "%u", w.drops);
  row("ledger's error", "%.1g", w.ledger_error);
  ImGui::EndTable();
}

void Overlay::drawStages() const {
  if (!ImGui::CollapsingHeader("plugin's stages, median ms", ImGuiTreeNodeFlags_DefaultOpen) ||
      !beginTable("stages", 3))
    return;
  row("", "CPU");
  cell("GPU");
  for (const rg_stage_stats& s : slow_.stages) {
    row(s.name, "%.3f ", s.cpu_ms_p50);
    if (s.gpu != 0)
      cell("%.3f", s.gpu_ms_p50);
    else
      ImGui::TableNextColumn();
  }
  ImGui::EndTable();
}

void Overlay::drawWeather(Stage& stage) const {
  Simulation& sim = stage.simulation();
  if (!ImGui::CollapsingHeader("weather and wipers", ImGuiTreeNodeFlags_DefaultOpen)) return;
  double rain_mm_h = sim.weather().rain_mm_h;
  if (slider("rain", rain_mm_h, 0.0, 200.0, "%.1f mm/h", ImGuiSliderFlags_Logarithmic))
    sim.overrides.rain_mm_h = rain_mm_h;
  double snow_mm_h = sim.weather().snow_mm_h, hail_mm_h = sim.weather().hail_mm_h;
  if (slider("snow", snow_mm_h, 0.0, 20.0, "%.1f mm/h", ImGuiSliderFlags_Logarithmic))
    sim.overrides.snow_mm_h = snow_mm_h;
  if (slider("hail", hail_mm_h, 0.0, 100.0, "%.1f mm/h", ImGuiSliderFlags_Logarithmic))
    sim.overrides.hail_mm_h = hail_mm_h;
  glm::dvec2 from_mps = windByCar(sim);
  bool blown = slider("wind from ahead", from_mps.x, -40.0, 40.0, "%.1f m/s");
  blown |= slider("wind from the left", from_mps.y, -40.0, 40.0, "%.1f m/s");
  if (blown) setWindByCar(sim, from_mps);
  if (ImGui::Button("weather as the scenario says")) {
    sim.overrides.rain_mm_h.reset();
    sim.overrides.snow_mm_h.reset();
    sim.overrides.hail_mm_h.reset();
    sim.overrides.wind_mps.reset();
  }
  wiperChoice(sim.overrides);
}

void Overlay::drawParameters(Stage& stage) {
  std::string_view group;
  bool open = false;
  for (rg_parameter& p : slow_.parameters) {
    if (group != p.group) {
      group = p.group;
      open =
          ImGui::CollapsingHeader(("plugin: " + std::string(group)).c_str(), ImGuiTreeNodeFlags_DefaultOpen);
    }
    if (open && parameterSlider(p)) stage.plugin().setParameter(p.name, p.value);
  }
}

}  // namespace host
