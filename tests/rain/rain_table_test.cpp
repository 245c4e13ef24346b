// The program rain_table, run as a user runs it, against the normative table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "run_program.h"

namespace testing_host {
namespace {

const std::string kHeader =
    "rate_mm_h,drops_m3,drops_gt1mm_m3,flux_m2s,flux_gt1mm_m2s,mean_d_air_mm,recovered_mm_h,water_g_m3,"
    "visibility_km";

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

// One map from column to cell for each row.
std::vector<std::map<std::string, std::string>> rowsOf(const std::string& csv) {
  const std::vector<std::string> lines = split(csv, '\n'), names = split(kHeader, ',');
  std::vector<std::map<std::string, std::string>> rows;
  if (lines.empty() || lines[0] != kHeader) return rows;
  for (size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = split(lines[i], ',');
    EXPECT_EQ(cells.size(), names.size()) << lines[i];
    auto& row = rows.emplace_back();
    for (size_t k = 0; k < std::min(cells.size(), names.size()); ++k) row[names[k]] = cells[k];
  }
  return rows;
}

// A number as the table prints it: what is held to it may be 1 % off, or half of its last digit where that is
// coarser.
struct Printed {
  double value, last_digit;
};
void expectCell(const std::map<std::string, std::string>& row, const char* column, const Printed& printed) {
  const std::string& cell = row.at(column);
  size_t used = 0;
  const double value = std::stod(cell, &used);
  EXPECT_EQ(used, cell.size()) << cell;
  EXPECT_NEAR(value, printed.value, std::max(0.01 * printed.value, 0.5 * printed.last_digit))
      << column << " at " << row.at("rate_mm_h") << " mm/h";
}

TEST(RainTable, isTheNormativeTable) {
  const Outcome run = runProgram("rain_table", "1 5 10 25 50 100");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  const auto rows = rowsOf(run.out);
  // Rate, drops/m3, > 1 mm, flux, > 1 mm, mean diameter, water, and the transmission over 100 m.
  constexpr double kTable[][8] = {
      {1, 226, 29, 676, 137, 0.74, 0.068, 0.97},      {5, 547, 127, 1816, 629, 0.84, 0.279, 0.91},
      {10, 777, 219, 2705, 1115, 0.90, 0.513, 0.86},  {25, 1207, 425, 4494, 2237, 0.98, 1.158, 0.76},
      {50, 1666, 676, 6540, 3658, 1.05, 2.158, 0.65}, {100, 2299, 1054, 9515, 5868, 1.14, 4.054, 0.51}};
  ASSERT_EQ(rows.size(), std::size(kTable));
  for (size_t i = 0; i < rows.size(); ++i) {
    expectCell(rows[i], "rate_mm_h", {kTable[i][0], 0.0});
    expectCell(rows[i], "drops_m3", {kTable[i][1], 1.0});
    expectCell(rows[i], "drops_gt1mm_m3", {kTable[i][2], 1.0});
    expectCell(rows[i], "flux_m2s", {kTable[i][3], 1.0});
    expectCell(rows[i], "flux_gt1mm_m2s", {kTable[i][4], 1.0});
    expectCell(rows[i], "mean_d_air_mm", {kTable[i][5], 0.01});
    expectCell(rows[i], "recovered_mm_h", {kTable[i][0], 0.0});
    expectCell(rows[i], "water_g_m3", {kTable[i][6], 0.001});
    // The range at which 5 % contrast is left is three optical depths off.
    const double visibility_m = 1e3 * std::stod(rows[i].at("visibility_km"));
    EXPECT_NEAR(std::exp(-3.0 * 100.0 / visibility_m), kTable[i][7], 0.005) << "at " << kTable[i][0];
  }
}

TEST(RainTable, isTotalOverTheWholeRange) {
  const auto rows = rowsOf(runProgram("rain_table", "0 0.001 0.1 300").out);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].at("drops_m3"), "0");
  EXPECT_EQ(rows[0].at("recovered_mm_h"), "0");
  EXPECT_EQ(rows[0].at("mean_d_air_mm"), "");
  EXPECT_EQ(rows[0].at("visibility_km"), "inf");
  double drops_before = 0.0, visibility_before_km = HUGE_VAL;
  for (size_t i = 1; i < rows.size(); ++i) {
    const double rate = std::stod(rows[i].at("rate_mm_h")), drops = std::stod(rows[i].at("drops_m3")),
                 visibility_km = std::stod(rows[i].at("visibility_km"));
    EXPECT_NEAR(std::stod(rows[i].at("recovered_mm_h")), rate, 1e-4 * rate);
    EXPECT_GT(drops, drops_before);
    EXPECT_LT(visibility_km, visibility_before_km);
    drops_before = drops;
    visibility_before_km = visibility_km;
  }
}

TEST(RainTable, helpNamesEveryColumn) {
  const Outcome run = runProgram("rain_table", "--help");
  EXPECT_EQ(run.exit_code, 0);
  for (const std::string& column : split(kHeader, ','))
    EXPECT_NE(run.out.find(column), std::string::npos) << column;
}

TEST(RainTable, wrongUsageIsOneLineThatNamesItAndExitCode2) {
  for (const char* rate :
       {"-5", "nan", "inf", "1e999", "300.001", "heavy", "5x", "0x10", "''", "' 5'", "5,10", "--rates"}) {
    const Outcome run = runProgram("rain_table", std::string("10 ") + rate);
    EXPECT_EQ(run.exit_code, 2) << rate;
    EXPECT_EQ(run.out, "") << rate;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    std::string named = rate;
    std::erase(named, '\'');
    EXPECT_NE(run.err.find('"' + named + '"'), std::string::npos) << run.err;
  }
  EXPECT_EQ(runProgram("rain_table", "").exit_code, 2);
}

}  // namespace
}  // namespace testing_host
