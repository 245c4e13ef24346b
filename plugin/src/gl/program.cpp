#include "gl/program.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "gl/error.h"
#include "gl/loader.h"

namespace rg::gl {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  return text;
}

// What follows `#include` on a line, or empty when the line is none.
std::string_view includeOperand(std::string_view line) {
  line = trimmed(line);
  if (!line.starts_with('#')) return {};
  line = trimmed(line.substr(1));
  return line.starts_with("include") ? trimmed(line.substr(7)) : std::string_view{};
}

std::string lineDirective(size_t line, size_t file) {
  return "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
}

class Resolver {
 public:
  explicit Resolver(SourceFn source) : source_(source) {}

  void add(std::string_view path, const std::string& wanted_by) {
    if (std::find(out.files.begin(), out.files.end(), path) != out.files.end()) return;
    std::string_view text = source_(path);
    if (text.empty())
      throw Error(Error::Kind::kDriver,
                  wanted_by + ": there is no shader file \"" + std::string(path) + "\"");
    const size_t file = out.files.size();
    out.files.emplace_back(path);
    out.text += lineDirective(1, file);
    for (size_t line = 1; !text.empty(); ++line) {
      const size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
      addLine(text.substr(0, end), line, file);
      text.remove_prefix(end);
    }
    if (!out.text.ends_with('\n')) out.text += '\n';
  }

  ShaderText out;

 private:
  void addLine(std::string_view text, size_t line, size_t file) {
    const std::string_view operand = includeOperand(text);
    if (operand.empty()) {
      out.text += text;
      return;
    }
    const std::string place = out.files[file] + ":" + std::to_string(line);
    const size_t close = operand.find('"', 1);
    if (operand.front() == '"' && close != std::string_view::npos) {
      add(operand.substr(1, close - 1), place);
    } else if (operand.front() != '<') {
      throw Error(Error::Kind::kDriver, place + ": #include wants a path in quotes");
    }
    out.text += lineDirective(line + 1, file);
  }

  SourceFn source_;
};

// Parses "12:34" or "12(34)" at the front of a log line: file number, line number and what follows. False
// when it is neither.
bool parsePlace(std::string_view text, size_t& file, std::string_view& line, std::string_view& rest) {
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), file);
  const auto digits = static_cast<size_t>(parsed.ptr - text.data());
  if (parsed.ec != std::errc{} || digits >= text.size()) return false;
  const char open = text[digits];
  if (open != ':' && open != '(') return false;
  const std::string_view after = text.substr(digits + 1);
  const size_t length = std::min(after.find_first_not_of("0123456789"), after.size());
  if (length == 0) return false;
  line = after.substr(0, length);
  rest = after.substr(length);
  if (open == '(' && rest.starts_with(')')) rest.remove_prefix(1);
  return true;
}

GLenum shaderKind(std::string_view path) {
  if (path.ends_with(".vert")) return GL_VERTEX_SHADER;
  if (path.ends_with(".frag")) return GL_FRAGMENT_SHADER;
  if (path.ends_with(".comp")) return GL_COMPUTE_SHADER;
  if (path.ends_with(".geom")) return GL_GEOMETRY_SHADER;
  throw Error(Error::Kind::kDriver,
              std::string(path) + ": a shader file ends in .vert, .frag, .comp or .geom");
}

template <class GetLog>
std::string readLog(GLint length, GetLog getLog) {
  std::string log(static_cast<size_t>(std::max(length, 1)), '\0');
  GLsizei written = 0;
  getLog(length, &written, log.data());
  log.resize(static_cast<size_t>(written));
  return log;
}

// Lives as long as the program has it.
GLuint attachShader(const GladGLContext& gl, GLuint program, GLenum kind, const std::string& text) {
  const GLuint shader = gl.CreateShader(kind);
  const char* start = text.c_str();
  gl.ShaderSource(shader, 1, &start, nullptr);
  gl.CompileShader(shader);
  gl.AttachShader(program, shader);
  gl.DeleteShader(shader);
  return shader;
}

std::string joined(std::span<const std::string_view> paths) {
  std::string all;
  for (const std::string_view path : paths) all.append(all.empty() ? "" : ", ").append(path);
  return all;
}

}  // namespace

ShaderText resolveIncludes(std::string_view path, std::span<const std::string> defines, SourceFn source) {
  Resolver resolver(source);
  resolver.out.text = "#version 450 core\n";
  for (const std::string& define : defines) resolver.out.text += "#define " + define + "\n";
  resolver.add(path, "building a program");
  return std::move(resolver.out);
}

std::string nameFilesInLog(std::string_view log, std::span<const std::string> files) {
  std::string named;
  while (!log.empty()) {
    const size_t end = std::min(log.find('\n'), log.size() - 1) + 1;
    const std::string_view text = log.substr(0, end);
    size_t file = 0;
    std::string_view line, rest;
    if (parsePlace(text, file, line, rest) && file < files.size()) {
      named.append(files[file]).append(":").append(line).append(rest);
    } else {
      named.append(text);
    }
    log.remove_prefix(end);
  }
  return named;
}

Building buildingOf(const GladGLContext& gl) {
  const auto* renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  if (renderer != nullptr && isSoftwareRenderer(renderer)) return Building::when_used;
  return gl.KHR_parallel_shader_compile != 0 ? Building::side_by_side : Building::at_once;
}

// How a program comes to be, whoever has it now.
class ProgramBuild {
 public:
  ProgramBuild(const GladGLContext& gl, GLuint program, std::initializer_list<std::string_view> paths,
               std::span<const std::string> defines, SourceFn source)
      : gl_(gl),
        program_(program),
        paths_(paths),
        defines_(defines.begin(), defines.end()),
        source_(source) {}

  // Asks for no result: that would wait for it.
  void begin() {
    std::vector<std::string> texts;
    for (const std::string_view path : paths_) {
      shaderKind(path);
      texts.push_back(resolveIncludes(path, defines_, source_).text);
    }
    for (size_t k = 0; k < paths_.size(); ++k)
      shaders_.push_back(attachShader(gl_, program_, shaderKind(paths_[k]), texts[k]));
    gl_.LinkProgram(program_);
  }

  void finish() {
    if (built_) return;
    if (shaders_.empty()) begin();
    GLint ok = 0;
    gl_.GetProgramiv(program_, GL_LINK_STATUS, &ok);
    if (!ok) refuse();
    std::string label = joined(paths_);
    for (const std::string& define : defines_) label += " " + define;
    gl_.ObjectLabel(GL_PROGRAM, program_, static_cast<GLsizei>(label.size()), label.c_str());
    built_ = true;
  }

 private:
  [[noreturn]] void refuse() const;

  const GladGLContext& gl_;
  GLuint program_;
  std::vector<std::string_view> paths_;
  std::vector<std::string> defines_;
  SourceFn source_;
  std::vector<GLuint> shaders_;  // of `paths_`, once it is begun; the program keeps them alive
  bool built_ = false;
};

namespace {
constexpr GLuint kAsManyAsItLikes = 0xffffffffu;
}

// Some drivers use no threads before they are asked to.
BegunPrograms::BegunPrograms(GladGLContext& gl) : gl_(gl) {
  gl.userptr = this;
  if (gl.MaxShaderCompilerThreadsKHR == nullptr) return;
  GLint64 threads = 0;
  gl.GetInteger64v(GL_MAX_SHADER_COMPILER_THREADS_KHR, &threads);
  threads_ = static_cast<GLuint>(threads);
  gl.MaxShaderCompilerThreadsKHR(kAsManyAsItLikes);
}

BegunPrograms::~BegunPrograms() {
  gl_.userptr = nullptr;
  if (gl_.MaxShaderCompilerThreadsKHR != nullptr) gl_.MaxShaderCompilerThreadsKHR(threads_);
}

void BegunPrograms::finish() {
  for (const auto& build : builds_) build->finish();
  builds_.clear();
}

Program::Program(const GladGLContext& gl, std::initializer_list<std::string_view> paths,
                 std::span<const std::string> defines, SourceFn source)
    : Object(gl, gl.CreateProgram()),
      build_(std::make_shared<ProgramBuild>(gl, Object::name(), paths, defines, source)) {
  const Building when = buildingOf(gl);
  if (when != Building::when_used) build_->begin();
  if (when == Building::at_once) build_->finish();
  auto* begun = static_cast<BegunPrograms*>(gl.userptr);
  if (when == Building::side_by_side && begun != nullptr) begun->builds_.push_back(build_);
}

void Program::finish() const { build_->finish(); }

void ProgramBuild::refuse() const {
  GLint ok = 0, length = 0;
  for (size_t k = 0; k < shaders_.size(); ++k) {
    gl_.GetShaderiv(shaders_[k], GL_COMPILE_STATUS, &ok);
    if (ok) continue;
    gl_.GetShaderiv(shaders_[k], GL_INFO_LOG_LENGTH, &length);
    const std::string log = readLog(length, [&](GLsizei size, GLsizei* written, char* to) {
      gl_.GetShaderInfoLog(shaders_[k], size, written, to);
    });
    throw Error(Error::Kind::kDriver,
                std::string(paths_[k]) + " does not compile:\n" +
                    nameFilesInLog(log, resolveIncludes(paths_[k], defines_, source_).files));
  }
  gl_.GetProgramiv(program_, GL_INFO_LOG_LENGTH, &length);
  const std::string log = readLog(length, [&](GLsizei size, GLsizei* written, char* to) {
    gl_.GetProgramInfoLog(program_, size, written, to);
  });
  throw Error(Error::Kind::kDriver, joined(paths_) + " do not link:\n" + log);
}

}  // namespace rg::gl
