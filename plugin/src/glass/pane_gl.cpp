#include "glass/pane_gl.h"

#include <algorithm>

#include "gl/objects.h"
#include "glass/film_gl.h"
#include "glass/mesh_cut.h"
#include "glass/pane_map.h"
#include "glass/slide.h"

namespace rg::glass {
namespace {

// The nearest texel with glass for each texel, so that maps can be read a little past the pane's edge.
std::vector<int> nearestGlass(const PaneMap& map) {
  const glm::ivec2 size = map.grid().size;
  std::vector<int> nearest(static_cast<size_t>(map.texelCount()), -1), front;
  for (int i = 0; i < map.texelCount(); ++i) {
    if (!map.inside(i)) continue;
    nearest[static_cast<size_t>(i)] = i;
    front.push_back(i);
  }
  for (std::vector<int> next; !front.empty(); front = std::exchange(next, {})) {
    for (const int i : front) {
      const glm::ivec2 at(i % size.x, i / size.x);
      for (const glm::ivec2 d : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
        const glm::ivec2 q = at + d;
        if (q.x < 0 || q.y < 0 || q.x >= size.x || q.y >= size.y) continue;
        int& known = nearest[static_cast<size_t>(q.y * size.x + q.x)];
        if (known >= 0) continue;
        known = nearest[static_cast<size_t>(i)];
        next.push_back(q.y * size.x + q.x);
      }
    }
  }
  return nearest;
}

struct Maps {
  gl::Texture2D position, metric;
  gl::Texture2DArray frame;
};

Maps makeMaps(const GladGLContext& gl, const PaneMap& map) {
  const glm::ivec2 size = map.grid().size;
  const std::vector<int> nearest = nearestGlass(map);
  std::vector<glm::vec4> position, metric, along_u, along_v;
  for (int i = 0; i < map.texelCount(); ++i) {
    const int glass = nearest[static_cast<size_t>(i)];
    const PaneTexel& t = map.texel(glass);
    const glm::vec2 d(map.middleOf(i) - map.middleOf(glass));
    const glm::vec3 u = glm::normalize(t.along_x), v = glm::normalize(t.along_y);
    const auto texel_m = static_cast<float>(map.grid().texel_m);
    position.emplace_back(t.position_m + d.x * t.along_x + d.y * t.along_y, 1.0f);
    metric.emplace_back(glm::length(t.along_x) * texel_m, glm::length(t.along_y) * texel_m, glm::dot(u, v),
                        t.area_m2);
    along_u.emplace_back(u, 0.0f);
    along_v.emplace_back(v, 0.0f);
  }
  Maps maps;
  maps.position = gl::Texture2D(gl, GL_RGBA32F, size.x, size.y);
  maps.metric = gl::Texture2D(gl, GL_RGBA32F, size.x, size.y);
  maps.frame = gl::Texture2DArray(gl, GL_RGBA16F, size.x, size.y, 2);
  maps.position.write(0, 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, position.data());
  maps.metric.write(0, 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, metric.data());
  maps.frame.write(0, 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, along_u.data());
  maps.frame.write(0, 0, 0, 1, size.x, size.y, GL_RGBA, GL_FLOAT, along_v.data());
  for (gl::Texture* texture : std::initializer_list<gl::Texture*>{&maps.position, &maps.metric, &maps.frame})
    texture->filter(GL_LINEAR, GL_LINEAR);
  return maps;
}

// The mesh with uv that spans the grid from 0 to 1.
std::vector<float> gridVertices(const PaneMesh& mesh, const PaneGrid& grid) {
  std::vector<float> vertices = mesh.vertices;
  const glm::dvec2 extent = glm::dvec2(grid.size) * grid.texel_m;
  for (size_t i = 0; i + 7 < vertices.size(); i += 8) {
    const glm::dvec2 uv(vertices[i + 6], vertices[i + 7]);
    const glm::vec2 out((uv - grid.uv_origin) * grid.metres_per_uv / extent);
    vertices[i + 6] = out.x;
    vertices[i + 7] = out.y;
  }
  return vertices;
}

}  // namespace

struct PaneGl::Parts {
  Parts(const GladGLContext& context, std::shared_ptr<FilmPrograms> programs, std::shared_ptr<PaneSim> pane)
      : gl(context),
        sim(std::move(pane)),
        film(gl, std::move(programs), sim->map(), sim->unevenness()),
        maps(makeMaps(gl, sim->map())) {
    cutMesh();
  }

  void uploadDrops();
  template <class Record>
  void upload(gl::Buffer& to, const std::vector<Record>& records) const;
  void cutMesh();

  const GladGLContext& gl;
  std::shared_ptr<PaneSim> sim;
  FilmGl film;
  Maps maps;
  gl::Buffer vertices, indices, pieces, drops, craters;
  size_t index_count = 0, piece_index_count = 0;
  double gone_at_m = 0.0;  // how far it slides until all of it is behind the sill
  std::shared_ptr<const PaneSnapshot> drawn;
};

PaneGl::PaneGl(const GladGLContext& gl, std::shared_ptr<FilmPrograms> programs, std::shared_ptr<PaneSim> sim)
    : parts_(std::make_unique<Parts>(gl, std::move(programs), std::move(sim))) {
  parts_->sim->attachFilm();
}

PaneGl::~PaneGl() { parts_->sim->detachFilm(); }

template <class Record>
void PaneGl::Parts::upload(gl::Buffer& to, const std::vector<Record>& records) const {
  const size_t bytes = records.size() * sizeof(Record);
  if (to.bytes() < bytes || !to) to = gl::Buffer(gl, std::max<size_t>(bytes * 2, 64 * sizeof(Record)));
  if (bytes > 0) to.write(0, records.data(), bytes);
}

void PaneGl::Parts::uploadDrops() {
  auto now = sim->snapshot();
  if (now == drawn) return;
  drawn = std::move(now);
  upload(drops, drawn->drops);
  upload(craters, drawn->craters);
}

void PaneGl::Parts::cutMesh() {
  PaneMesh mesh = sim->mesh();
  for (const uint32_t i : mesh.indices) {
    const float* at = &mesh.vertices[size_t{8} * i];
    gone_at_m = std::max(gone_at_m, sim->slide().way_m({at[0], at[1], at[2]}));
  }
  mesh.vertices = gridVertices(mesh, sim->map().grid());
  const PieceMesh cut = cutIntoPieces(mesh, sim->map().grid().size);
  vertices = gl::Buffer(gl, std::span<const float>(cut.mesh.vertices));
  indices = gl::Buffer(gl, std::span<const uint32_t>(cut.mesh.indices));
  pieces = gl::Buffer(gl, std::span<const uint32_t>(cut.first));
  index_count = cut.tiles;
  piece_index_count = cut.mesh.indices.size();
}

// Ticks wait for reports, reports for steps, steps for the orders of ticks: round and round until no tick
// waits.
void PaneGl::run(std::span<PaneGl* const> panes, bool wait_for_all) {
  std::vector<FilmGl*> films;
  for (PaneGl* pane : panes) films.push_back(&pane->parts_->film);
  for (bool goes_on = true; goes_on;) {
    std::vector<std::vector<FilmOrder>> orders;
    for (PaneGl* pane : panes) orders.push_back(pane->parts_->sim->fetchOrders());
    FilmGl::runTogether(films, orders);
    goes_on = false;
    for (PaneGl* pane : panes) {
      Parts& p = *pane->parts_;
      for (FilmReport& report : p.film.collect(wait_for_all || p.sim->waiting())) {
        p.sim->deliver(std::move(report));
        goes_on = true;
      }
    }
    for (PaneGl* pane : panes) goes_on = pane->parts_->sim->resume() || goes_on;
  }
  for (PaneGl* pane : panes) pane->parts_->uploadDrops();
}

void PaneGl::step(std::span<PaneGl* const> panes) { run(panes, false); }

void PaneGl::step() {
  PaneGl* self = this;
  run(std::span(&self, 1), false);
}

void PaneGl::finish(std::span<PaneGl* const> panes) { run(panes, true); }

void PaneGl::finish() {
  PaneGl* self = this;
  finish(std::span(&self, 1));
}

PaneDrawn PaneGl::drawn(double opening_m) const {
  const PaneMap& map = parts_->sim->map();
  const Slide& slide = parts_->sim->slide();
  PaneDrawn out;
  out.vertex_buffer = parts_->vertices.name();
  out.index_buffer = parts_->indices.name();
  out.piece_buffer = parts_->pieces.name();
  const bool hides = slide.hides(opening_m);
  if (!hides || opening_m < parts_->gone_at_m) out.index_count = static_cast<int32_t>(parts_->index_count);
  if (hides) out.sill = slide.seenWhere(opening_m);
  out.piece_index_count = static_cast<int32_t>(parts_->piece_index_count);
  out.slid_m = opening_m * slide.direction();
  out.centre_m = map.centre_m();
  out.radius_m = map.radius_m();
  out.film = parts_->film.picture().name();
  out.film_size = map.grid().size;
  out.beads = parts_->film.beadsPicture().name();
  out.position = parts_->maps.position.name();
  out.metric = parts_->maps.metric.name();
  out.frame = parts_->maps.frame.name();
  out.right_handed = map.rightHanded();
  out.texel_m = static_cast<float>(map.grid().texel_m);
  if (parts_->drawn) {
    out.drop_buffer = parts_->drops.name();
    out.drop_count = static_cast<int32_t>(parts_->drawn->drops.size());
    out.crater_buffer = parts_->craters.name();
    out.crater_count = static_cast<int32_t>(parts_->drawn->craters.size());
    out.drop_tick = parts_->drawn->tick;
    out.ridge_buffer = parts_->film.ridges().name();
    out.blades = parts_->drawn->blades;
    out.advancing_rad = parts_->drawn->advancing_rad;
    out.bead_contact_rad = parts_->drawn->bead_contact_rad;
  }
  return out;
}

std::vector<int32_t> PaneGl::readFilm() {
  finish();
  return parts_->film.readFilm();
}

std::vector<uint32_t> PaneGl::readBeads() {
  finish();
  return parts_->film.readBeads();
}

FilmState PaneGl::filmState() {
  finish();
  return parts_->film.state();
}

void PaneGl::setFilm(const FilmState& state) { parts_->film.set(state); }

uint64_t PaneGl::hash() {
  finish();
  uint64_t h = 0xcbf29ce484222325ull;
  const auto mix = [&h](const auto& list) {
    for (const auto value : list) h = (h ^ static_cast<uint32_t>(value)) * 0x100000001b3ull + (h >> 29);
  };
  mix(parts_->film.readFilm());
  mix(parts_->film.readBeads());
  mix(parts_->film.readRidges());
  return h;
}

void PaneGl::abandon() {
  Parts& p = *parts_;
  p.film.abandon();
  p.maps.position.forget();
  p.maps.metric.forget();
  p.maps.frame.forget();
  p.vertices.forget();
  p.indices.forget();
  p.pieces.forget();
  p.drops.forget();
  p.craters.forget();
}

}  // namespace rg::glass
