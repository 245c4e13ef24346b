// GL objects that free themselves. All are made and changed through direct state access: nothing here touches
// what the host has bound. They keep a pointer to the context's functions, which must outlive them. The
// context must be current when one is made or destroyed; when it has been lost, call forget() on each
// instead.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>

namespace rg::gl {

// Owns one GL name. Move-only; empty after a move, reset or forget.
template <void (*Delete)(const GladGLContext&, GLuint)>
class Object {
 public:
  Object() = default;
  Object(const GladGLContext& gl, GLuint name) : gl_(&gl), name_(name) {}
  Object(Object&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    if (this != &other) {
      reset();
      gl_ = other.gl_;
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() { reset(); }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void reset() {
    if (name_ != 0) Delete(*gl_, std::exchange(name_, 0));
  }
  void forget() { name_ = 0; }  // the context is gone, and the object with it

 protected:
  const GladGLContext& gl() const { return *gl_; }

 private:
  const GladGLContext* gl_ = nullptr;
  GLuint name_ = 0;
};

namespace detail {
void deleteBuffer(const GladGLContext& gl, GLuint name);
void deleteTexture(const GladGLContext& gl, GLuint name);
void deleteSampler(const GladGLContext& gl, GLuint name);
void deleteFramebuffer(const GladGLContext& gl, GLuint name);
void deleteVertexArray(const GladGLContext& gl, GLuint name);
void deleteQuery(const GladGLContext& gl, GLuint name);
void deleteProgram(const GladGLContext& gl, GLuint name);
}  // namespace detail

// Immutable storage of `bytes` (at least 1). `flags` as of glNamedBufferStorage; write() needs
// GL_DYNAMIC_STORAGE_BIT.
class Buffer : public Object<detail::deleteBuffer> {
 public:
  Buffer() = default;
  Buffer(const GladGLContext& gl, size_t bytes, GLbitfield flags = GL_DYNAMIC_STORAGE_BIT,
         const void* data = nullptr);
  template <class T>
  Buffer(const GladGLContext& gl, std::span<const T> data, GLbitfield flags = 0)
      : Buffer(gl, data.size_bytes(), flags, data.data()) {}

  size_t bytes() const { return bytes_; }
  void write(size_t offset, const void* data, size_t bytes);
  template <class T>
  void write(size_t offset, std::span<const T> data) {
    write(offset, data.data(), data.size_bytes());
  }
  void zero();                                               // all of it, on the GPU
  void zero(size_t offset, size_t bytes);                    // both multiples of 4
  void read(size_t offset, void* data, size_t bytes) const;  // waits for the GPU
  // For persistently mapped rings. Throws Error::kDriver.
  void* map(size_t offset, size_t bytes, GLbitfield access);

 private:
  size_t bytes_ = 0;
};

// `internal_format` is sized (GL_RGBA16F). A fresh texture is NEAREST without mipmaps, else LINEAR with them,
// and CLAMP_TO_EDGE.
class Texture : public Object<detail::deleteTexture> {
 public:
  int width() const { return width_; }
  int height() const { return height_; }
  int layers() const { return layers_; }  // of an array, slices of a volume, else 1
  int levels() const { return levels_; }
  GLenum format() const { return format_; }
  void filter(GLenum minimize, GLenum magnify);
  void wrap(GLenum mode);
  void generateMipmaps();
  // One layer's rectangle from client memory, tight rows; the guard has set pixel store to its defaults (see
  // state_guard.h).
  void write(int level, int x, int y, int layer, int width, int height, GLenum format, GLenum type,
             const void* pixels);
  void zero(int level = 0);

 protected:
  Texture() = default;
  Texture(const GladGLContext& gl, GLenum target, GLenum internalFormat, int width, int height, int layers,
          int levels);

 private:
  GLenum target_ = 0, format_ = 0;
  int width_ = 0, height_ = 0, layers_ = 1, levels_ = 1;
};

struct Texture2D : Texture {
  Texture2D() = default;
  Texture2D(const GladGLContext& gl, GLenum internalFormat, int width, int height, int levels = 1)
      : Texture(gl, GL_TEXTURE_2D, internalFormat, width, height, 1, levels) {}
};
struct Texture2DArray : Texture {
  Texture2DArray() = default;
  Texture2DArray(const GladGLContext& gl, GLenum internalFormat, int width, int height, int layers,
                 int levels = 1)
      : Texture(gl, GL_TEXTURE_2D_ARRAY, internalFormat, width, height, layers, levels) {}
};
struct Texture3D : Texture {
  Texture3D() = default;
  Texture3D(const GladGLContext& gl, GLenum internalFormat, int width, int height, int depth, int levels = 1)
      : Texture(gl, GL_TEXTURE_3D, internalFormat, width, height, depth, levels) {}
};
struct TextureCube : Texture {  // write()'s layer is the face
  TextureCube() = default;
  TextureCube(const GladGLContext& gl, GLenum internalFormat, int size, int levels = 1)
      : Texture(gl, GL_TEXTURE_CUBE_MAP, internalFormat, size, size, 1, levels) {}
};

// A buffer seen as an array of texels: a range of it, from a multiple of 256 bytes on.
class BufferTexture : public Object<detail::deleteTexture> {
 public:
  BufferTexture() = default;
  explicit BufferTexture(const GladGLContext& gl);
  // Throws Error::kDriver when it is more than the driver can show.
  void show(GLenum internalFormat, size_t texel_bytes, const Buffer& buffer, size_t offset, size_t bytes);
};

// Levels of a full mip chain.
int fullMipLevels(int width, int height);

class Sampler : public Object<detail::deleteSampler> {
 public:
  Sampler() = default;
  Sampler(const GladGLContext& gl, GLenum minimize, GLenum magnify, GLenum wrap);
};

class Framebuffer : public Object<detail::deleteFramebuffer> {
 public:
  Framebuffer() = default;
  explicit Framebuffer(const GladGLContext& gl);
  // Attachments 0.. of the list, all of them drawn. `level` counts for all.
  Framebuffer(const GladGLContext& gl, std::initializer_list<const Texture*> colors,
              const Texture* depth = nullptr, int level = 0);
  void attachColor(GLuint index, GLuint texture, int level = 0);
  void attachColorLayer(GLuint index, GLuint texture, int level, int layer);
  void attachDepth(GLuint texture, int level = 0);
  void drawColors(int count);                    // draw buffers 0..count-1
  void requireComplete(const char* what) const;  // throws Error::kDriver
};

class VertexArray : public Object<detail::deleteVertexArray> {
 public:
  VertexArray() = default;
  explicit VertexArray(const GladGLContext& gl);
  void bindBuffer(GLuint binding, GLuint buffer, size_t offset, int stride, GLuint divisor = 0);
  void bindIndices(GLuint buffer);
  void attribute(GLuint location, GLuint binding, int components, GLenum type, GLuint offset,
                 bool normalized = false);
  void integerAttribute(GLuint location, GLuint binding, int components, GLenum type, GLuint offset);
};

// Of target GL_TIMESTAMP: the only kind the plugin uses (see rainglass.h).
class TimestampQuery : public Object<detail::deleteQuery> {
 public:
  TimestampQuery() = default;
  explicit TimestampQuery(const GladGLContext& gl);
  void stamp();
  bool ready() const;
  uint64_t ns() const;  // waits unless ready
};

// A fence in the command stream.
class Fence {
 public:
  Fence() = default;
  explicit Fence(const GladGLContext& gl);  // put in now
  Fence(Fence&& other) noexcept : gl_(other.gl_), sync_(std::exchange(other.sync_, nullptr)) {}
  Fence& operator=(Fence&& other) noexcept;
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;
  ~Fence() { reset(); }
  explicit operator bool() const { return sync_ != nullptr; }
  bool passed() const;  // never waits
  void wait() const;    // until the GPU has passed it; throws Error::kDriver when the driver gives up
  void reset();
  void forget() { sync_ = nullptr; }

 private:
  const GladGLContext* gl_ = nullptr;
  GLsync sync_ = nullptr;
};

}  // namespace rg::gl
