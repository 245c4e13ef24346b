#include "glass/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace rg::glass {
namespace {

constexpr double kEven = 1.25;  // a length on the chart is nowhere more than so many times off its mean

// Vertices at one place are one, though they may have been split for uv or shading.
std::vector<uint32_t> weld(const PaneInfo& info) {
  std::vector<uint32_t> order(info.positions_m.size()), of(order.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t i) {
    const glm::vec3& p = info.positions_m[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::stable_sort(order, {}, key);
  for (size_t i = 0; i < order.size(); ++i)
    of[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? of[order[i - 1]] : order[i];
  return of;
}

// Two triangles meet in an edge that lies at two places of the host's uvs.
bool hasSeams(const PaneInfo& info, const std::vector<uint32_t>& welded) {
  struct Edge {
    uint32_t a, b;
    glm::vec2 uv_a, uv_b;
  };
  std::vector<Edge> edges;
  for (size_t i = 0; i < info.indices.size(); ++i) {
    uint32_t a = info.indices[i], b = info.indices[i % 3 == 2 ? i - 2 : i + 1];
    if (welded[a] > welded[b]) std::swap(a, b);
    edges.push_back({welded[a], welded[b], info.uvs[a], info.uvs[b]});
  }
  std::ranges::stable_sort(edges, {}, [](const Edge& e) { return std::pair(e.a, e.b); });
  for (size_t i = 1; i < edges.size(); ++i) {
    const Edge &e = edges[i - 1], &f = edges[i];
    if (e.a == f.a && e.b == f.b && (e.uv_a != f.uv_a || e.uv_b != f.uv_b)) return true;
  }
  return false;
}

// Whether lengths on the chart are in the same measure everywhere, and no part of it is turned over.
bool isEven(const PaneInfo& info, const Chart& chart) {
  const glm::dvec2 scale = metresPerUnit(info, chart);
  const bool turned = triangleOf(info, chart, 0).uvArea() < 0.0;
  for (size_t t = 0; t < info.indices.size() / 3; ++t) {
    const ChartTriangle triangle = triangleOf(info, chart, t);
    const auto [du, dv] = triangle.derivatives();
    const double uu = glm::dot(du, du) / (scale.x * scale.x), vv = glm::dot(dv, dv) / (scale.y * scale.y);
    const double uv = glm::dot(du, dv) / (scale.x * scale.y);
    const double spread = std::hypot(0.5 * (uu - vv), uv), middle = 0.5 * (uu + vv);  // squares of lengths
    const bool even = middle + spread <= kEven * kEven && middle - spread >= 1.0 / (kEven * kEven);
    if (!even || (triangle.uvArea() < 0.0) != turned) return false;
  }
  return true;
}

// Looked for on a grid as fine as the smallest gaps that charts have.
void refuseOverlap(const PaneInfo& info, const Chart& uvs) {
  constexpr int kCells = 2048;
  constexpr double kClear = 1e-3;  // of a barycentric coordinate: clearly inside
  glm::dvec2 low{1e300}, high{-1e300};
  for (const uint32_t i : info.indices) {
    low = glm::min(low, uvs[i]);
    high = glm::max(high, uvs[i]);
  }
  const glm::dvec2 cell = (high - low) / static_cast<double>(kCells);
  std::vector<bool> covered(size_t{kCells} * kCells, false);
  for (size_t t = 0; t < info.indices.size() / 3; ++t) {
    std::array<glm::dvec2, 3> uv = triangleOf(info, uvs, t).uv;
    for (glm::dvec2& p : uv) p = (p - low) / cell;
    const glm::dvec2 e = uv[1] - uv[0], f = uv[2] - uv[0];
    const double inv = 1.0 / (e.x * f.y - e.y * f.x);
    const glm::ivec2 first(glm::min(glm::min(uv[0], uv[1]), uv[2]));
    const glm::ivec2 last = glm::min(glm::ivec2(glm::max(glm::max(uv[0], uv[1]), uv[2])), kCells - 1);
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - uv[0];
        const double b = (d.x * f.y - d.y * f.x) * inv, c = (e.x * d.y - e.y * d.x) * inv;
        if (std::min({1.0 - b - c, b, c}) <= kClear) continue;
        const size_t i = static_cast<size_t>(y) * kCells + static_cast<size_t>(x);
        if (covered[i]) {
          const glm::dvec2 at = low + (uv[0] + d) * cell;
          refusePane(info, "its uvs overlap at (" + std::to_string(at.x) + ", " + std::to_string(at.y) + ")");
        }
        covered[i] = true;
      }
    }
  }
}

// A mesh laid flat with its triangles turned, and bent as little as can be: as rigid as possible, by turns
// finding each triangle's rotation and the places that fit them best (Liu, Zhang, Xu, Gotsman & Gortler 2008,
// "A local/global approach to mesh parameterization"). A developable pane comes out true to length.
class Flattening {
 public:
  Flattening(const PaneInfo& info, const std::vector<uint32_t>& welded) : places_(info.positions_m.size()) {
    glm::dvec3 normal{0.0};
    for (size_t t = 0; t < info.indices.size() / 3; ++t) {
      Triangle& triangle = triangles_.emplace_back();
      std::array<glm::dvec3, 3> p;
      for (size_t k = 0; k < 3; ++k) {
        triangle.vertex[k] = welded[info.indices[3 * t + k]];
        p[k] = glm::dvec3(info.positions_m[triangle.vertex[k]]);
      }
      const glm::dvec3 area = glm::cross(p[1] - p[0], p[2] - p[0]);
      const double twice_m2 = glm::length(area);
      triangle.normal = area / twice_m2;
      normal += area;
      // Its own plane, its first edge along x; cotangents of the angles that face its edges.
      const glm::dvec3 x = glm::normalize(p[1] - p[0]), y = glm::cross(triangle.normal, x);
      for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 edge = p[(k + 1) % 3] - p[k], other = p[(k + 2) % 3] - p[k];
        triangle.edge_m[k] = {glm::dot(edge, x), glm::dot(edge, y)};
        triangle.cotangent[(k + 1) % 3] = glm::dot(edge, other) / twice_m2;
      }
    }
    normal_ = glm::length(normal) > 0.0 ? glm::normalize(normal) : glm::dvec3(0.0);
    const glm::dvec3 vertical = std::abs(normal_.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 up = glm::normalize(vertical - glm::dot(vertical, normal_) * normal_);
    const glm::dvec3 right = glm::cross(up, normal_);  // seen from outside
    for (size_t i = 0; i < places_.size(); ++i) {
      const glm::dvec3 p(info.positions_m[i]);
      places_[i] = {glm::dot(p, right), glm::dot(p, up)};
    }
  }

  // As its shadow along the mean normal at first: none where some of it faces away from that.
  std::optional<Chart> laidFlat() {
    constexpr double kFacing = 0.05;
    constexpr int kMostRounds = 5;  // the first does nearly all
    constexpr double kStill_m = 2e-4;
    for (const Triangle& triangle : triangles_) {
      if (glm::dot(triangle.normal, normal_) < kFacing) return std::nullopt;
    }
    for (int round = 0; round < kMostRounds; ++round) {
      if (settle() < kStill_m) break;
    }
    for (const Triangle& triangle : triangles_) {
      const glm::dvec2 a = edgeOf(triangle, 0), b = edgeOf(triangle, 2);
      if (!(a.y * b.x - a.x * b.y > 0.0)) return std::nullopt;
    }
    return places_;
  }

 private:
  struct Triangle {
    std::array<uint32_t, 3> vertex;
    std::array<glm::dvec2, 3> edge_m;  // from a vertex to the next, true
    std::array<double, 3> cotangent;   // of the angle that faces each
    glm::dvec3 normal;
  };

  glm::dvec2 edgeOf(const Triangle& t, size_t k) const {
    return places_[t.vertex[(k + 1) % 3]] - places_[t.vertex[k]];
  }

  template <typename Add>
  void eachEdge(const Triangle& t, Add add) const {
    for (size_t k = 0; k < 3; ++k) add(t.vertex[k], t.vertex[(k + 1) % 3], t.cotangent[k], k);
  }

  Chart stiffness(const Chart& x) const {
    Chart out(x.size(), glm::dvec2(0.0));
    for (const Triangle& t : triangles_) {
      eachEdge(t, [&](uint32_t a, uint32_t b, double weight, size_t) {
        const glm::dvec2 pull = weight * (x[b] - x[a]);
        out[b] += pull;
        out[a] -= pull;
      });
    }
    return out;
  }

  // One round; says how far a vertex moved at most. Conjugate gradients: the middle, which no edge holds,
  // stays where it was.
  double settle() {
    constexpr int kMostSteps = 300;
    constexpr double kResidual = 1e-6;
    Chart wanted(places_.size(), glm::dvec2(0.0));
    for (const Triangle& t : triangles_) {
      glm::dvec2 turn{0.0};  // as a complex number: of the true edges to those that are
      eachEdge(t, [&](uint32_t, uint32_t, double weight, size_t k) {
        const glm::dvec2 e = t.edge_m[k], u = edgeOf(t, k);
        turn += weight * glm::dvec2(e.x * u.x + e.y * u.y, e.x * u.y - e.y * u.x);
      });
      turn = glm::length(turn) > 0.0 ? glm::normalize(turn) : glm::dvec2(1.0, 0.0);
      eachEdge(t, [&](uint32_t a, uint32_t b, double weight, size_t k) {
        const glm::dvec2 e = t.edge_m[k];
        const glm::dvec2 pull = weight * glm::dvec2(turn.x * e.x - turn.y * e.y, turn.y * e.x + turn.x * e.y);
        wanted[b] += pull;
        wanted[a] -= pull;
      });
    }
    const auto product = [](const Chart& a, const Chart& b) {
      double sum = 0.0;
      for (size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
      return sum;
    };
    const Chart before = places_;
    Chart residual = stiffness(places_);
    for (size_t i = 0; i < residual.size(); ++i) residual[i] = wanted[i] - residual[i];
    Chart way = residual;
    double square = product(residual, residual);
    const double enough = kResidual * kResidual * product(wanted, wanted);
    for (int step = 0; step < kMostSteps && square > enough; ++step) {
      const Chart bent = stiffness(way);
      const double share = square / product(way, bent);
      for (size_t i = 0; i < way.size(); ++i) {
        places_[i] += share * way[i];
        residual[i] -= share * bent[i];
      }
      const double next = product(residual, residual);
      for (size_t i = 0; i < way.size(); ++i) way[i] = residual[i] + next / square * way[i];
      square = next;
    }
    double moved_m = 0.0;
    for (size_t i = 0; i < before.size(); ++i)
      moved_m = std::max(moved_m, glm::distance(before[i], places_[i]));
    return moved_m;
  }

  std::vector<Triangle> triangles_;
  Chart places_;
  glm::dvec3 normal_;
};

}  // namespace

void refusePane(const PaneInfo& info, const std::string& why) {
  throw std::invalid_argument("pane '" + info.name + "': " + why);
}

ChartTriangle triangleOf(const PaneInfo& info, const Chart& chart, size_t t) {
  ChartTriangle out;
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t i = info.indices[3 * t + k];
    out.p[k] = info.positions_m[i];
    out.uv[k] = chart[i];
  }
  return out;
}

glm::dvec2 metresPerUnit(const PaneInfo& info, const Chart& chart) {
  glm::dvec2 square{0.0};
  double area = 0.0;
  for (size_t t = 0; t < info.indices.size() / 3; ++t) {
    const ChartTriangle triangle = triangleOf(info, chart, t);
    const auto [du, dv] = triangle.derivatives();
    const double a = glm::length(triangle.normal_area());
    square += a * glm::dvec2(glm::dot(du, du), glm::dot(dv, dv));
    area += a;
  }
  return glm::sqrt(square / area);
}

Chart chartOf(const PaneInfo& info) {
  Chart given(info.uvs.begin(), info.uvs.end());
  const std::vector<uint32_t> welded = weld(info);
  const bool seams = hasSeams(info, welded);

  if (!seams && isEven(info, given)) return given;
  refuseOverlap(info, given);
  std::optional<Chart> flat = Flattening(info, welded).laidFlat();
  if (!flat && seams)
    refusePane(info, "its uvs have seams, and it is too curved to be laid flat without them");
  if (!flat) return given;
  for (size_t i = 0; i < flat->size(); ++i) (*flat)[i] = (*flat)[welded[i]];
  return *flat;
}

}  // namespace rg::glass
