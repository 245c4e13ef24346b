#include "rain/exponential.h"

#include <algorithm>
#include <cmath>

namespace rg::rain {

// By parts.
double moment(int n, double a, double x, double y) {
  double sum = 0.0, factor = 1.0 / a;
  for (int k = n; k >= 0; --k) {
    sum += factor * (std::pow(x, k) * std::exp(-a * x) - std::pow(y, k) * std::exp(-a * y));
    factor *= k / a;
  }
  return sum;
}

double quantile(double a, double from, double to, double u) {
  if (!(a > 0.0)) return from;
  const double part = -std::expm1(-a * (to - from));
  return std::clamp(from - std::log1p(-u * part) / a, from, to);
}

}  // namespace rg::rain
