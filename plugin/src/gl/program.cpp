#include "gl/program.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "gl/error.h"

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

// A shader for the time of linking.
struct Shader {
  const GladGLContext& gl;
  GLuint name;
  Shader(const GladGLContext& context, GLenum kind) : gl(context), name(context.CreateShader(kind)) {}
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { gl.DeleteShader(name); }
};

void compile(const Shader& shader, std::string_view path, std::span<const std::string> defines,
             SourceFn source) {
  const GladGLContext& gl = shader.gl;
  const ShaderText resolved = resolveIncludes(path, defines, source);
  const char* text = resolved.text.c_str();
  gl.ShaderSource(shader.name, 1, &text, nullptr);
  gl.CompileShader(shader.name);
  GLint ok = 0, length = 0;
  gl.GetShaderiv(shader.name, GL_COMPILE_STATUS, &ok);
  if (ok) return;
  gl.GetShaderiv(shader.name, GL_INFO_LOG_LENGTH, &length);
  const std::string log = readLog(length, [&](GLsizei size, GLsizei* written, char* to) {
    gl.GetShaderInfoLog(shader.name, size, written, to);
  });
  throw Error(Error::Kind::kDriver,
              std::string(path) + " does not compile:\n" + nameFilesInLog(log, resolved.files));
}

void link(const GladGLContext& gl, GLuint program, const std::string& paths) {
  gl.LinkProgram(program);
  GLint ok = 0, length = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &ok);
  if (ok) return;
  gl.GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  const std::string log = readLog(length, [&](GLsizei size, GLsizei* written, char* to) {
    gl.GetProgramInfoLog(program, size, written, to);
  });
  throw Error(Error::Kind::kDriver, paths + " do not link:\n" + log);
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

Program::Program(const GladGLContext& gl, std::initializer_list<std::string_view> paths,
                 std::span<const std::string> defines, SourceFn source)
    : Object(gl, gl.CreateProgram()) {
  std::string all;
  for (const std::string_view path : paths) {
    const Shader shader(gl, shaderKind(path));
    compile(shader, path, defines, source);
    gl.AttachShader(name(), shader.name);  // the program keeps it alive until it is detached or deleted
    all.append(all.empty() ? "" : ", ").append(path);
  }
  link(gl, name(), all);
  gl.ObjectLabel(GL_PROGRAM, name(), static_cast<GLsizei>(all.size()), all.c_str());
}

}  // namespace rg::gl
