// The ledger's test can fail: whichever kernel loses 1 % of its water, CPU's or GPU's, the ledger does not
// close any more.
#include <gtest/gtest.h>

#include "gl_fixture.h"
#include "glass/ledger.h"
#include "glass/scene.h"

namespace rg::test {
namespace {

class Leak : public GlTest {
 protected:
  // Share of the catch that is missing after two seconds of a wiped downpour on a pane that then dries.
  double missing(glass::FilmKernel gpu, glass::LeakyKernel cpu) {
    const Mesh mesh = windscreen(0.6, 0.4, rad(30), 0.03);
    glass::PaneInfo info = paneInfo(mesh);
    info.glass = glass::Glass::dirty;
    glass::leaky_kernel = cpu;
    Simulation sim(gl, info, gpu);
    sim.sim->setWiper(3, wiper(rad(30), 0.4));
    const WiperMotor motor(3, rad(20), rad(150), 70.0);
    sim.run(weather(100.0, 15.0, 0.3), 2.0, &motor);
    glass::leaky_kernel = glass::LeakyKernel::none;
    const glass::PaneStats s = sim.stats();
    return static_cast<double>(s.caught_pl - sumOf(s)) / static_cast<double>(s.caught_pl);
  }
};

TEST_F(Leak, ofEachKernelIsSeenByTheLedger) {
  EXPECT_EQ(missing(glass::FilmKernel::none, glass::LeakyKernel::none), 0.0);
  using Gpu = glass::FilmKernel;
  for (const Gpu kernel :
       {Gpu::take, Gpu::add, Gpu::ridge, Gpu::sweep, Gpu::leave, Gpu::step, Gpu::bead_add, Gpu::bead}) {
    EXPECT_NE(missing(kernel, glass::LeakyKernel::none), 0.0) << "GPU kernel " << static_cast<int>(kernel);
  }
  using Cpu = glass::LeakyKernel;
  for (const Cpu kernel :
       {Cpu::impact, Cpu::merge, Cpu::evaporation, Cpu::trail, Cpu::collect, Cpu::exchange}) {
    EXPECT_NE(missing(Gpu::none, kernel), 0.0) << "CPU kernel " << static_cast<int>(kernel);
  }
}

}  // namespace
}  // namespace rg::test
