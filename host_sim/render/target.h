// What a picture is drawn into: HDR colour and depth, both textures, so that the plugin can read them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "window/context.h"

namespace host {

/// RGBA16F colour and 32-bit float depth.
class Target {
 public:
  Target(const Context& context, glm::ivec2 size_px);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Makes the textures anew when the size differs; the names change then.
  void resize(glm::ivec2 size_px);
  glm::ivec2 sizePx() const { return size_px_; }
  std::uint32_t framebuffer() const { return framebuffer_; }
  std::uint32_t colour() const { return colour_; }
  std::uint32_t depth() const { return depth_; }

 private:
  void release();
  const GladGLContext& gl_;
  glm::ivec2 size_px_{0};
  GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

/// Colour alone, to be read between its pixels.
class ColourPicture {
 public:
  ColourPicture(const GladGLContext& gl, glm::ivec2 size_px);
  ~ColourPicture();
  ColourPicture(const ColourPicture&) = delete;
  ColourPicture& operator=(const ColourPicture&) = delete;

  glm::ivec2 sizePx() const { return size_px_; }
  std::uint32_t framebuffer() const { return framebuffer_; }
  std::uint32_t texture() const { return colour_; }

 private:
  const GladGLContext& gl_;
  glm::ivec2 size_px_;
  GLuint framebuffer_ = 0, colour_ = 0;
};

/// Colour with mips, and depth: what wet ground mirrors.
class MirrorPicture {
 public:
  MirrorPicture(const GladGLContext& gl, glm::ivec2 size_px);
  ~MirrorPicture();
  MirrorPicture(const MirrorPicture&) = delete;
  MirrorPicture& operator=(const MirrorPicture&) = delete;

  glm::ivec2 sizePx() const { return size_px_; }
  std::uint32_t framebuffer() const { return framebuffer_; }
  std::uint32_t texture() const { return colour_; }

 private:
  const GladGLContext& gl_;
  glm::ivec2 size_px_;
  GLuint framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

/// An sRGB picture to be read back: what toneMap writes when there is no window.
class Picture {
 public:
  Picture(const Context& context, glm::ivec2 size_px);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  glm::ivec2 sizePx() const { return size_px_; }
  std::uint32_t framebuffer() const { return framebuffer_; }
  /// RGB, 8 bits each, top row first.
  std::vector<std::uint8_t> read() const;

 private:
  const GladGLContext& gl_;
  glm::ivec2 size_px_;
  GLuint framebuffer_ = 0, colour_ = 0;
};

/// Binds it and sets what all passes of this host draw with: its viewport, reversed depth, all masks open, no
/// blending, no scissors, counter-clockwise faces.
void beginPicture(const GladGLContext& gl, GLuint framebuffer, glm::ivec2 size_px);

}  // namespace host
