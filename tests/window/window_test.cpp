// The window as a person meets it, on a display that nobody sees: keys, mouse, size, the ways out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "display.h"
#include "run_host.h"

namespace testing_window {
namespace {

using testing_host::freshFolder;
using testing_host::report;

class Window : public testing::Test {
 protected:
  void SetUp() override {
    if (!Display::canBeHad())
      GTEST_SKIP() << "Xvfb is not installed (package xvfb): no display to open a window on";
    display_ = std::make_unique<Display>();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Small and without rain before the drive: software GL is slow. The window is there when its title tells
  // the speed.
  void open(const std::string& more = "", const std::string& size = "320x180") {
    std::vector<std::string> words{"--size",     size,    "--set",         "prewarm_s=0",
                                   "--gl-debug", "--out", folder_.string()};
    std::istringstream in(more);
    for (std::string word; in >> word;) words.push_back(word);
    host_ = std::make_unique<Process>(
        std::string(RG_BIN_DIR) + "/host_sim", words,
        std::vector<std::string>{"DISPLAY=" + display_->name(), "LIBGL_ALWAYS_SOFTWARE=1"});
    wait([&] { return host_->ended() || (window_ = display_->find("Rainglass  ")) != 0; });
  }
  std::string title() const { return display_->title(window_); }
  bool titleSays(const std::string& text) {
    return wait([&] { return host_->ended() || title().find(text) != std::string::npos; }) && !host_->ended();
  }
  // The number before `unit`: "rain 5.0 mm/h" has 5.0 before "mm/h".
  double told(const std::string& name) const {
    const std::string text = title();
    const auto at = text.find(name);
    return at == std::string::npos ? -1.0 : std::strtod(text.c_str() + at + name.size(), nullptr);
  }
  double speedKmh() const { return told("Rainglass  "); }
  bool becomes(const std::function<bool()>& so) {
    return wait([&] { return host_->ended() || so(); }) && !host_->ended();
  }
  void press(const char* key, bool shifted = false) { display_->press(window_, key, shifted); }
  void expectCleanEnd() {
    ASSERT_TRUE(wait([&] { return host_->ended().has_value(); })) << "it did not end";
    EXPECT_EQ(*host_->ended(), 0);
    const auto json = report(folder_);
    ASSERT_TRUE(json.is_object());
    EXPECT_GT(json["frames"], 0);
    EXPECT_EQ(json["gl_errors"], 0);
  }

  std::filesystem::path folder_ = freshFolder("window");
  std::unique_ptr<Display> display_;
  std::unique_ptr<Process> host_;
  unsigned long window_ = 0;
};

TEST_F(Window, drivesTheAskedTimeAndReports) {
  open("--seconds 2");
  expectCleanEnd();
  const auto json = report(folder_);
  EXPECT_EQ(json["simulated_s"], 2.0);
  EXPECT_GT(json["rain"]["born"], 0);
  EXPECT_EQ(json["size"], nlohmann::json({320, 180}));
}

TEST_F(Window, keysChangeCameraWeatherAndWipers) {
  open("--scenario parked");
  ASSERT_TRUE(titleSays("rain 10.0 mm/h  wipers off  cockpit"));
  press("c");
  EXPECT_TRUE(titleSays("bumper")) << title();
  press("r");
  EXPECT_TRUE(titleSays("rain 15.8 mm/h")) << title();
  press("r", true);
  press("r", true);
  EXPECT_TRUE(titleSays("rain 6.3 mm/h")) << title();
  press("0");
  EXPECT_TRUE(titleSays("rain 10.0 mm/h")) << title();
  press("2");
  EXPECT_TRUE(titleSays("wipers 2")) << title();
  press("Escape");
  expectCleanEnd();
}

TEST_F(Window, arrowsTakeTheWheelAndBackspaceGivesItBack) {
  open("--scenario parked");
  ASSERT_TRUE(titleSays("0 km/h  "));
  display_->hold(window_, "Up", true);
  EXPECT_TRUE(titleSays("by hand")) << title();
  EXPECT_TRUE(becomes([&] { return speedKmh() >= 5.0; })) << title();
  display_->hold(window_, "Up", false);
  display_->hold(window_, "Down", true);
  EXPECT_TRUE(becomes([&] { return speedKmh() <= 1.0; })) << title();
  display_->hold(window_, "Down", false);
  press("BackSpace");
  EXPECT_TRUE(becomes([&] { return title().find("by hand") == std::string::npos; })) << title();
  press("Escape");
  expectCleanEnd();
}

TEST_F(Window, pausesTakesPicturesAndClosesByItsFrame) {
  open();
  ASSERT_NE(window_, 0U);
  press("p");
  ASSERT_TRUE(titleSays("paused")) << title();
  press("F2");
  const auto shots = [&] {
    return std::ranges::count_if(std::filesystem::directory_iterator(folder_),
                                 [](const auto& file) { return file.path().extension() == ".png"; });
  };
  EXPECT_TRUE(becomes([&] { return shots() == 1; }));
  display_->close(window_);
  expectCleanEnd();
}

// Where F5 was, F9 goes back to, as often as asked; what cannot be is told, and takes nothing away.
TEST_F(Window, savesTheMomentAndGoesBackToIt) {
  open("--scenario parked");
  ASSERT_TRUE(titleSays("0 km/h  "));
  press("F9");
  EXPECT_TRUE(titleSays("saved.run: there is no such file")) << title();
  press("F5");
  ASSERT_TRUE(titleSays("saved at")) << title();
  const double saved_s = told("saved at ");
  const auto driveOffAndGoBack = [&] {
    display_->hold(window_, "Up", true);
    EXPECT_TRUE(becomes([&] { return speedKmh() >= 5.0; })) << title();
    display_->hold(window_, "Up", false);
    press("F9");
    EXPECT_TRUE(titleSays("back at")) << title();
    EXPECT_EQ(told("back at "), saved_s);
    EXPECT_EQ(speedKmh(), 0.0);
  };
  driveOffAndGoBack();

  std::filesystem::create_directories(folder_ / "saved.run.part" / "in the way");
  press("F5");
  EXPECT_TRUE(titleSays("saved.run: cannot be written")) << title();
  driveOffAndGoBack();
  press("Escape");
  expectCleanEnd();
}

TEST_F(Window, followsItsSize) {
  open("--scenario parked --seconds 600");
  ASSERT_NE(window_, 0U);
  display_->resize(window_, 200, 240);
  press("c");  // drawn anew after the size came
  ASSERT_TRUE(titleSays("bumper")) << title();
  press("Escape");
  expectCleanEnd();
  EXPECT_EQ(report(folder_)["size"], nlohmann::json({200, 240}));
}

// The rain's slider lies near the upper right corner.
TEST_F(Window, aSliderOfThePanelSetsTheRain) {
  open("--scenario parked", "800x600");
  ASSERT_TRUE(titleSays("rain 10.0 mm/h")) << title();
  press("F1");
  press("1");
  ASSERT_TRUE(titleSays("wipers 1")) << title();  // the panel has been drawn
  press("2");
  ASSERT_TRUE(titleSays("wipers 2")) << title();
  display_->point(window_, 440, 55, true);
  EXPECT_TRUE(becomes([&] { return std::abs(told("rain ") - 10.0) > 0.1; })) << title();
  display_->point(window_, 440, 55, false);
  press("Escape");
  expectCleanEnd();
}

TEST(WindowRefused, withoutAnyServerOnTheDisplayItIsOneLine) {
  const auto run = testing_host::runHost("--out " + freshFolder("no_server").string(),
                                         "env -u WAYLAND_DISPLAY DISPLAY=:6543");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(":6543"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--headless"), std::string::npos) << run.err;
}

TEST(WindowRefused, whatNeedsNoWindowIsRefusedInOne) {
  for (const char* option : {"--video v.mp4", "--shots 1", "--budget b.toml"}) {
    const auto run = testing_host::runHost(option, "env DISPLAY=:6543");
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_NE(run.err.find("--headless"), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace testing_window
