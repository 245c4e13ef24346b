// Sizes that are spread as exp(-a D): what the laws of rain, snow and hail have in common.
#pragma once

namespace rg::rain {

// Integral of D^n exp(-a D) from x to y, n >= 0, a > 0.
double moment(int n, double a, double x, double y);

// The size below which the share u (0..1) of those between the two lies. a <= 0: from.
double quantile(double a, double from, double to, double u);

}  // namespace rg::rain
