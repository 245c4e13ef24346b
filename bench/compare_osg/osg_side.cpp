#include "osg_side.h"

#include <algorithm>
#include <cmath>
#include <osg/Geometry>
#include <osg/Notify>
#include <osgParticle/PrecipitationEffect>
#include <osgViewer/Viewer>

namespace compare {
namespace {

// As far as Rainglass shows large drops, all of them as streaks (OSG draws what is farther as points).
constexpr float kReach_m = 8.0f;
constexpr float kIntensity = 1.0f;  // of OSG's rain: heavy

// Looks inside for the cells drawn, to count their streaks.
class Rain : public osgParticle::PrecipitationEffect {
 public:
  Rain() {
    rain(kIntensity);
    setNearTransition(kReach_m);
    setFarTransition(kReach_m);
    setCellSize(osg::Vec3(1.0f, 1.0f, 2.0f));  // OSG draws 1024 streaks a cell at most
  }

  // As its vertex shader places them: the two ends of each streak, whose box touches the picture or not.
  double seen(const osg::Matrix& projection, double time_s) {
    const auto& points = static_cast<const osg::Vec3Array&>(*_quadGeometry->getVertexArray());
    double count = 0.0;
    for (auto& [view, set] : _viewDrawableMap) {
      auto& drawable = *set._quadPrecipitationDrawable;
      const size_t streaks = std::min<size_t>(drawable.getNumberOfVertices(), points.size()) / 4;
      for (const auto& [cell, here] : drawable.getCurrentCellMatrixMap()) {
        const auto before = drawable.getPreviousCellMatrixMap().find(cell);
        const osg::Matrix& was =
            before != drawable.getPreviousCellMatrixMap().end() ? before->second.modelview : here.modelview;
        for (size_t i = 0; i < streaks; ++i)
          count += touches(points[4 * i], here, was, projection, time_s) ? 1.0 : 0.0;
      }
    }
    return count;
  }

 private:
  bool touches(osg::Vec3 p, const PrecipitationDrawable::DepthMatrixStartTime& cell, const osg::Matrix& was,
               const osg::Matrix& projection, double time_s) const {
    const double turns = (time_s - static_cast<double>(cell.startTime)) / static_cast<double>(_period) -
                         static_cast<double>(p.z());
    p.z() = static_cast<float>(turns - std::floor(turns));
    osg::Vec3 moved = p;
    moved.z() += static_cast<float>(kExposure_s / static_cast<double>(_period));
    const osg::Vec3d a = osg::Vec3d(moved) * cell.modelview, b = osg::Vec3d(p) * was;
    if (a.z() > -kNear_m || b.z() > -kNear_m) return false;
    const osg::Vec3d on[2] = {a * projection, b * projection};
    return std::min(on[0].x(), on[1].x()) < 1.0 && std::max(on[0].x(), on[1].x()) > -1.0 &&
           std::min(on[0].y(), on[1].y()) < 1.0 && std::max(on[0].y(), on[1].y()) > -1.0;
  }
};

}  // namespace

struct OsgSide::Viewer {
  Viewer(uint32_t framebuffer, osg::Node* scene) {
    viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    auto* window = viewer.setUpViewerAsEmbeddedInWindow(0, 0, kWidth_px, kHeight_px);
    window->setDefaultFboId(framebuffer);
    osg::Camera& camera = *viewer.getCamera();
    camera.setDrawBuffer(GL_COLOR_ATTACHMENT0);
    camera.setReadBuffer(GL_COLOR_ATTACHMENT0);
    camera.setClearColor(osg::Vec4(0, 0, 0, 0));
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setProjectionMatrixAsPerspective(osg::RadiansToDegrees(kFieldOfView_rad),
                                            static_cast<double>(kWidth_px) / kHeight_px, kNear_m, kFar_m);
    viewer.setLightingMode(osg::View::NO_LIGHT);
    viewer.setSceneData(scene);
    viewer.realize();
  }

  // Time is the moment's, not the clock's: OSG's streaks are as long as the last frame took.
  void frame(const Moment& m) {
    const osg::Vec3d eye(m.x_m(), 0.0, kEyeHeight_m);
    viewer.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(1, 0, 0), osg::Vec3d(0, 0, 1));
    viewer.advance(m.time_s());
    viewer.getFrameStamp()->setReferenceTime(m.time_s());
    viewer.eventTraversal();
    viewer.updateTraversal();
    viewer.renderingTraversals();
  }

  osgViewer::Viewer viewer;
  osg::ref_ptr<Rain> rain;
  double time_s = 0.0;
};

OsgSide::OsgSide(uint32_t framebuffer) {
  osg::setNotifyLevel(osg::FATAL);  // it tells of each drawable that goes
  osg::ref_ptr<Rain> rain = new Rain;
  rain_ = std::make_unique<Viewer>(framebuffer, rain.get());
  rain_->rain = rain;
  empty_ = std::make_unique<Viewer>(framebuffer, new osg::Group);
}
OsgSide::~OsgSide() = default;

void OsgSide::draw(const Moment& moment) {
  rain_->time_s = moment.time_s();
  rain_->frame(moment);
}
void OsgSide::drawEmpty(const Moment& moment) { empty_->frame(moment); }
double OsgSide::streaksSeen() {
  return rain_->rain->seen(rain_->viewer.getCamera()->getProjectionMatrix(), rain_->time_s);
}
void OsgSide::setDensity(double per_m3) {
  rain_->rain->setMaximumParticleDensity(static_cast<float>(per_m3));
}
void OsgSide::setParticleSize(double m) { rain_->rain->setParticleSize(static_cast<float>(m)); }

}  // namespace compare
