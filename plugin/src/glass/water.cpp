#include "glass/water.h"

namespace rg::glass {
namespace {
constexpr double rad(double degrees) { return degrees * std::numbers::pi / 180.0; }
}  // namespace

Surface surfaceOf(Glass glass) {
  switch (glass) {
    case Glass::dirty:
      return {rad(60), rad(20), 120.0, 4e-6, 80e-6, 40e-6, 0.6, 90e-6, 5e-6};
    // From coatings any film draws back that is thinner than 2 l_c sin(theta / 2), 4 mm (de Gennes,
    // Brochard-Wyart & Quere 2004, ch. 2): all that there are (kOverfull_m).
    case Glass::coated:
      return {rad(110), rad(90), 60.0, 5e-6, 250e-6, 400e-6, 10.0, 1.0, 0.0};
    case Glass::new_coating:
      return {rad(105), rad(98), 40.0, 5e-6, 250e-6, 400e-6, 15.0, 1.0, 0.0};
    case Glass::uncoated:
      break;
  }
  return {rad(40), rad(10), 100.0, 3e-6, 40e-6, 40e-6, 2.0, 60e-6, 7e-6};
}

}  // namespace rg::glass
