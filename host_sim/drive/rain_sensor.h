// The rain sensor of automatic wipers: from the water that the windscreen catches to a wiper mode, with a
// dead band so that it does not waver.
#pragma once

#include "drive/wiper_control.h"

namespace host {

class RainSensor {
 public:
  // Water caught on the pane so far, at a time.
  void sense(double caught_m3, double area_m2, double time_s);
  WiperMode mode() const { return mode_; }
  // Between wipes, so that about the same water lies on the glass before each.
  double pause_s() const;
  double rate_mm_h() const { return rate_mm_h_; }  // on the glass, smoothed

  template <class Fields>
  void visit(Fields& f) {
    f("begun", begun_), f("caught_m3", caught_m3_), f("time_s", time_s_), f("rate_mm_h", rate_mm_h_);
    f("mode", mode_, WiperMode::off, WiperMode::fast);
  }

 private:
  bool begun_ = false;
  double caught_m3_ = 0.0, time_s_ = 0.0, rate_mm_h_ = 0.0;
  WiperMode mode_ = WiperMode::off;
};

}  // namespace host
