// rain_table RATE...: what the plugin makes of a rate in mm/h, as CSV.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "rain/size_law.h"

namespace {

using namespace rg::rain;

constexpr const char* kHelp =
    R"(rain_table RATE...: prints as CSV what rain of each rate (0 .. 300 mm/h) is made of.

  rate_mm_h        the rate asked for
  drops_m3         drops of 0.5 .. 6 mm in a cubic metre of air
  drops_gt1mm_m3   of these above 1 mm
  flux_m2s         drops a second through a square metre of level ground
  flux_gt1mm_m2s   of these above 1 mm
  mean_d_air_mm    mean diameter of the drops in the air; empty without rain
  recovered_mm_h   the rate that comes back from the sizes, numbers and speeds, summed drop size by drop size
  water_g_m3       water in the air
  visibility_km    meteorological range in the rain alone: 3 / extinction; inf without rain

Sizes: Marshall & Palmer (1948), their N0 scaled so that the rate is delivered. Speeds: Atlas, Srivastava &
Sekhon (1973). Extinction: Weber et al. (2015). Exit codes: 0 done, 1 the table cannot be written, 2 wrong usage.
)";

// The water that falls, added up from the law's density by the midpoint rule: nothing of the closed forms by
// which the law was scaled.
double recovered_mm_h(const SizeLaw& law) {
  constexpr int kSteps = 20000;
  constexpr double kStep_mm = (kLargest_mm - kSmallest_mm) / kSteps;
  constexpr double kMmPerHour = 3.6e-3;  // of 1 mm3/(m2 s)
  double sum_mm3_m2s = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double d_mm = kSmallest_mm + (i + 0.5) * kStep_mm;
    const double drops_m3 = law.n0_per_m3_mm * std::exp(-law.slope_per_mm * d_mm) * kStep_mm;
    sum_mm3_m2s += std::numbers::pi / 6.0 * d_mm * d_mm * d_mm * fallSpeed(d_mm) * drops_m3;
  }
  return sum_mm3_m2s * kMmPerHour;
}

std::optional<double> rateFrom(std::string_view text) {
  double rate = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rate);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (!(rate >= 0.0 && rate <= kMaxRate_mm_h)) return std::nullopt;
  return rate + 0.0;  // "-0" too is no rain
}

void printRow(double rate_mm_h) {
  const SizeLaw law = SizeLaw::of(rate_mm_h);
  const auto cell = [](double value, const char* end = ",") { std::printf("%.6g%s", value, end); };
  cell(rate_mm_h);
  cell(law.numberDensity(kSmallest_mm, kLargest_mm));
  cell(law.numberDensity(1.0, kLargest_mm));
  cell(law.flux(kSmallest_mm, kLargest_mm));
  cell(law.flux(1.0, kLargest_mm));
  if (rate_mm_h > 0.0)
    cell(law.meanDiameter_mm());
  else
    std::printf(",");
  cell(recovered_mm_h(law));
  cell(law.water_g_m3());
  cell(1e-3 * visibility_m(rate_mm_h), "\n");
}

}  // namespace

int main(int argc, char** argv) {
  enum ExitCode { kDone = 0, kFailed = 1, kBadUsage = 2 };
  std::vector<double> rates_mm_h;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-h") == 0) {
      std::fputs(kHelp, stdout);
      return kDone;
    }
    const std::optional<double> rate = rateFrom(argv[i]);
    if (!rate) {
      std::fprintf(stderr, "rain_table: \"%s\" is no rate of 0 .. %g mm/h (see --help)\n", argv[i],
                   kMaxRate_mm_h);
      return kBadUsage;
    }
    rates_mm_h.push_back(*rate);
  }
  if (rates_mm_h.empty()) {
    std::fputs("rain_table: give one rate or more, in mm/h (see --help)\n", stderr);
    return kBadUsage;
  }
  std::puts(
      "rate_mm_h,drops_m3,drops_gt1mm_m3,flux_m2s,flux_gt1mm_m2s,mean_d_air_mm,recovered_mm_h,water_g_m3,"
      "visibility_km");
  for (const double rate : rates_mm_h) printRow(rate);
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    std::fputs("rain_table: standard output cannot be written\n", stderr);
    return kFailed;
  }
  return kDone;
}
