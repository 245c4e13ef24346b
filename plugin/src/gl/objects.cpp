#include "gl/objects.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdio>
#include <string>

#include "gl/error.h"

namespace rg::gl {
namespace {

GLuint made(const GladGLContext& gl, void(GLAD_API_PTR* create)(GLsizei, GLuint*), const char* what) {
  GLuint name = 0;
  create(1, &name);
  if (name == 0) throwOnError(gl, what);
  return name;
}

GLuint madeTexture(const GladGLContext& gl, GLenum target) {
  GLuint name = 0;
  gl.CreateTextures(target, 1, &name);
  return name;
}

constexpr std::array<GLenum, 3> kWrapAxes{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};

GLintptr signedSize(size_t bytes) { return static_cast<GLintptr>(bytes); }

}  // namespace

namespace detail {
void deleteBuffer(const GladGLContext& gl, GLuint name) { gl.DeleteBuffers(1, &name); }
void deleteTexture(const GladGLContext& gl, GLuint name) { gl.DeleteTextures(1, &name); }
void deleteSampler(const GladGLContext& gl, GLuint name) { gl.DeleteSamplers(1, &name); }
void deleteFramebuffer(const GladGLContext& gl, GLuint name) { gl.DeleteFramebuffers(1, &name); }
void deleteVertexArray(const GladGLContext& gl, GLuint name) { gl.DeleteVertexArrays(1, &name); }
void deleteQuery(const GladGLContext& gl, GLuint name) { gl.DeleteQueries(1, &name); }
void deleteProgram(const GladGLContext& gl, GLuint name) { gl.DeleteProgram(name); }
}  // namespace detail

Buffer::Buffer(const GladGLContext& gl, size_t bytes, GLbitfield flags, const void* data)
    : Object(gl, made(gl, gl.CreateBuffers, "making a buffer")), bytes_(std::max<size_t>(bytes, 1)) {
  gl.NamedBufferStorage(name(), signedSize(bytes_), bytes > 0 ? data : nullptr, flags);
}

void Buffer::write(size_t offset, const void* data, size_t bytes) {
  assert(offset + bytes <= bytes_);
  if (bytes > 0) gl().NamedBufferSubData(name(), signedSize(offset), signedSize(bytes), data);
}

void Buffer::zero() { gl().ClearNamedBufferData(name(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr); }

void Buffer::zero(size_t offset, size_t bytes) {
  gl().ClearNamedBufferSubData(name(), GL_R32UI, signedSize(offset), signedSize(bytes), GL_RED_INTEGER,
                               GL_UNSIGNED_INT, nullptr);
}

void Buffer::read(size_t offset, void* data, size_t bytes) const {
  gl().GetNamedBufferSubData(name(), signedSize(offset), signedSize(bytes), data);
}

void* Buffer::map(size_t offset, size_t bytes, GLbitfield access) {
  void* mapped = gl().MapNamedBufferRange(name(), signedSize(offset), signedSize(bytes), access);
  if (mapped == nullptr)
    throw Error(Error::Kind::kDriver, "the driver maps no buffer of " + std::to_string(bytes_) + " bytes");
  return mapped;
}

int fullMipLevels(int width, int height) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max({width, height, 1}))));
}

Texture::Texture(const GladGLContext& gl, GLenum target, GLenum internalFormat, int width, int height,
                 int layers, int levels)
    : Object(gl, madeTexture(gl, target)),
      target_(target),
      format_(internalFormat),
      width_(width),
      height_(height),
      layers_(layers),
      levels_(levels) {
  const bool layered = target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_3D;
  if (layered) {
    gl.TextureStorage3D(name(), levels, internalFormat, width, height, layers);
  } else {
    gl.TextureStorage2D(name(), levels, internalFormat, width, height);
  }
  filter(levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST, levels > 1 ? GL_LINEAR : GL_NEAREST);
  wrap(GL_CLAMP_TO_EDGE);
}

void Texture::filter(GLenum minimize, GLenum magnify) {
  gl().TextureParameteri(name(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minimize));
  gl().TextureParameteri(name(), GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magnify));
}

void Texture::wrap(GLenum mode) {
  for (const GLenum axis : kWrapAxes) {
    gl().TextureParameteri(name(), axis, static_cast<GLint>(mode));
  }
}

void Texture::generateMipmaps() { gl().GenerateTextureMipmap(name()); }

void Texture::write(int level, int x, int y, int layer, int width, int height, GLenum format, GLenum type,
                    const void* pixels) {
  if (target_ == GL_TEXTURE_2D) {
    gl().TextureSubImage2D(name(), level, x, y, width, height, format, type, pixels);
  } else {
    gl().TextureSubImage3D(name(), level, x, y, layer, width, height, 1, format, type, pixels);
  }
}

void Texture::zero(int level) {
  // The format of a null clear value only has to be of the texture's class: integer or not, depth or colour.
  GLint type = 0, depth_bits = 0;
  gl().GetTextureLevelParameteriv(name(), level, GL_TEXTURE_RED_TYPE, &type);
  gl().GetTextureLevelParameteriv(name(), level, GL_TEXTURE_DEPTH_SIZE, &depth_bits);
  const bool integer = type == GL_INT || type == GL_UNSIGNED_INT;
  const GLenum format = depth_bits > 0 ? GL_DEPTH_COMPONENT : integer ? GL_RED_INTEGER : GL_RED;
  gl().ClearTexImage(name(), level, format, integer ? GL_INT : GL_FLOAT, nullptr);
}

BufferTexture::BufferTexture(const GladGLContext& gl) : Object(gl, madeTexture(gl, GL_TEXTURE_BUFFER)) {}

void BufferTexture::show(GLenum internalFormat, size_t texel_bytes, const Buffer& buffer, size_t offset,
                         size_t bytes) {
  GLint most = 0;
  gl().GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (bytes / texel_bytes > static_cast<size_t>(most)) {
    throw Error(Error::Kind::kDriver,
                "the driver shows no more than " + std::to_string(most) + " texels of a buffer");
  }
  gl().TextureBufferRange(name(), internalFormat, buffer.name(), signedSize(offset), signedSize(bytes));
}

Sampler::Sampler(const GladGLContext& gl, GLenum minimize, GLenum magnify, GLenum wrap)
    : Object(gl, made(gl, gl.CreateSamplers, "making a sampler")) {
  gl.SamplerParameteri(name(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minimize));
  gl.SamplerParameteri(name(), GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magnify));
  for (const GLenum axis : kWrapAxes) {
    gl.SamplerParameteri(name(), axis, static_cast<GLint>(wrap));
  }
}

Framebuffer::Framebuffer(const GladGLContext& gl)
    : Object(gl, made(gl, gl.CreateFramebuffers, "making a framebuffer")) {}

Framebuffer::Framebuffer(const GladGLContext& gl, std::initializer_list<const Texture*> colors,
                         const Texture* depth, int level)
    : Framebuffer(gl) {
  GLuint index = 0;
  for (const Texture* color : colors) attachColor(index++, color->name(), level);
  if (depth) attachDepth(depth->name(), level);
  drawColors(static_cast<int>(colors.size()));
}

void Framebuffer::attachColor(GLuint index, GLuint texture, int level) {
  gl().NamedFramebufferTexture(name(), GL_COLOR_ATTACHMENT0 + index, texture, level);
}

void Framebuffer::attachColorLayer(GLuint index, GLuint texture, int level, int layer) {
  gl().NamedFramebufferTextureLayer(name(), GL_COLOR_ATTACHMENT0 + index, texture, level, layer);
}

void Framebuffer::attachDepth(GLuint texture, int level) {
  gl().NamedFramebufferTexture(name(), GL_DEPTH_ATTACHMENT, texture, level);
}

void Framebuffer::drawColors(int count) {
  std::array<GLenum, 8> buffers{};
  for (GLuint i = 0; i < buffers.size(); ++i) buffers[i] = GL_COLOR_ATTACHMENT0 + i;
  gl().NamedFramebufferDrawBuffers(name(), count, buffers.data());
}

void Framebuffer::requireComplete(const char* what) const {
  const GLenum status = gl().CheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  char code[16];
  std::snprintf(code, sizeof code, "0x%04X", status);
  throw Error(Error::Kind::kDriver, std::string(what) + ": the framebuffer is not complete (" + code + ")");
}

VertexArray::VertexArray(const GladGLContext& gl)
    : Object(gl, made(gl, gl.CreateVertexArrays, "making a vertex array")) {}

void VertexArray::bindBuffer(GLuint binding, GLuint buffer, size_t offset, int stride, GLuint divisor) {
  gl().VertexArrayVertexBuffer(name(), binding, buffer, signedSize(offset), stride);
  gl().VertexArrayBindingDivisor(name(), binding, divisor);
}

void VertexArray::bindIndices(GLuint buffer) { gl().VertexArrayElementBuffer(name(), buffer); }

void VertexArray::attribute(GLuint location, GLuint binding, int components, GLenum type, GLuint offset,
                            bool normalized) {
  gl().EnableVertexArrayAttrib(name(), location);
  gl().VertexArrayAttribFormat(name(), location, components, type, normalized ? GL_TRUE : GL_FALSE, offset);
  gl().VertexArrayAttribBinding(name(), location, binding);
}

void VertexArray::integerAttribute(GLuint location, GLuint binding, int components, GLenum type,
                                   GLuint offset) {
  gl().EnableVertexArrayAttrib(name(), location);
  gl().VertexArrayAttribIFormat(name(), location, components, type, offset);
  gl().VertexArrayAttribBinding(name(), location, binding);
}

TimestampQuery::TimestampQuery(const GladGLContext& gl) {
  GLuint query = 0;
  gl.CreateQueries(GL_TIMESTAMP, 1, &query);
  static_cast<Object&>(*this) = Object(gl, query);
}

void TimestampQuery::stamp() { gl().QueryCounter(name(), GL_TIMESTAMP); }

bool TimestampQuery::ready() const {
  GLuint available = 0;
  gl().GetQueryObjectuiv(name(), GL_QUERY_RESULT_AVAILABLE, &available);
  return available != 0;
}

uint64_t TimestampQuery::ns() const {
  GLuint64 result = 0;
  gl().GetQueryObjectui64v(name(), GL_QUERY_RESULT, &result);
  return result;
}

Fence::Fence(const GladGLContext& gl) : gl_(&gl), sync_(gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {}

Fence& Fence::operator=(Fence&& other) noexcept {
  if (this != &other) {
    reset();
    gl_ = other.gl_;
    sync_ = std::exchange(other.sync_, nullptr);
  }
  return *this;
}

bool Fence::passed() const {
  GLint status = GL_UNSIGNALED;
  gl_->GetSynciv(sync_, GL_SYNC_STATUS, 1, nullptr, &status);
  return status == GL_SIGNALED;
}

void Fence::wait() const {
  constexpr GLuint64 kPatience_ns =
      10'000'000'000;  // software GL can take seconds; a hung GPU is reset sooner
  const GLenum result = gl_->ClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, kPatience_ns);
  if (result == GL_TIMEOUT_EXPIRED || result == GL_WAIT_FAILED) {
    throw Error(Error::Kind::kDriver, "waiting for the GPU: it did not answer within 10 s");
  }
}

void Fence::reset() {
  if (sync_) gl_->DeleteSync(std::exchange(sync_, nullptr));
}

}  // namespace rg::gl
