#include "scene/gltf/document.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <system_error>

namespace host::gltf {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestJson_bytes = 64U
                                           << 20;  // a parsed document takes some 40 times its text at worst
constexpr int kDeepestJson = 64;                   // tinygltf walks extras recursively
constexpr std::size_t kGlbHeader_bytes = 12;
constexpr std::size_t kChunkHeader_bytes = 8;
constexpr std::uint32_t kChunkJson = 0x4E4F534A;  // "JSON", glTF 2.0, 4.4.3
constexpr std::uint32_t kChunkBin = 0x004E4942;   // "BIN\0"

std::uint32_t littleEndian(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8U |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16U | static_cast<std::uint32_t>(bytes[at + 3]) << 24U;
}

std::string afterBracket(const std::string& what) {
  const std::size_t at = what.find("] ");
  return at == std::string::npos ? what : what.substr(at + 2);
}

Json parseJson(const std::uint8_t* text, std::size_t size, const std::string& file) {
  if (size > kLargestJson_bytes) fail(file, "its JSON is larger than 64 MiB");
  const auto bounded = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > kDeepestJson)
      fail(file, "its JSON is nested deeper than " + std::to_string(kDeepestJson) + " levels");
    return true;
  };
  try {
    return Json::parse(text, text + size, bounded);
  } catch (const Json::exception& e) {
    fail(file, "is not valid JSON: " + afterBracket(e.what()));
  }
}

struct Chunk {
  std::uint32_t type;
  std::size_t begin;
  std::size_t size;
};

Chunk chunkAt(const Bytes& bytes, std::size_t at, std::size_t end, const std::string& file) {
  if (end - at < kChunkHeader_bytes) fail(file, "binary chunk at byte " + std::to_string(at) + " is cut off");
  const Chunk chunk{littleEndian(bytes, at + 4), at + kChunkHeader_bytes, littleEndian(bytes, at)};
  if (chunk.size > end - chunk.begin) {
    fail(file, "binary chunk at byte " + std::to_string(at) + " claims " + std::to_string(chunk.size) +
                   " bytes, but only " + std::to_string(end - chunk.begin) + " follow");
  }
  return chunk;
}

void readGlb(const Bytes& bytes, Document& document) {
  const std::string& file = document.file;
  if (bytes.size() < kGlbHeader_bytes) fail(file, "binary header is cut off");
  const std::uint32_t version = littleEndian(bytes, 4);
  if (version != 2) fail(file, "binary header: version is " + std::to_string(version) + ", must be 2");
  const std::size_t length = littleEndian(bytes, 8);
  if (length != bytes.size()) {
    fail(file, "binary header: length is " + std::to_string(length) + " bytes, but the file has " +
                   std::to_string(bytes.size()));
  }
  const Chunk text = chunkAt(bytes, kGlbHeader_bytes, length, file);
  if (text.type != kChunkJson) fail(file, "first binary chunk is not JSON");
  document.json = parseJson(bytes.data() + text.begin, text.size, file);
  const std::size_t next = text.begin + text.size;
  if (next == length) return;
  const Chunk bin = chunkAt(bytes, next, length, file);
  if (bin.type != kChunkBin) return;  // unknown chunks are to be ignored (glTF 2.0, 4.4.3.1)
  document.has_bin = true;
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(bin.begin);
  document.bin.assign(begin, begin + static_cast<std::ptrdiff_t>(bin.size));
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percentDecoded(const std::string& uri, const std::string& where) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text.push_back(uri[i]);
      continue;
    }
    const int high = i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hexDigit(uri[i + 2]) : -1;
    if (high < 0 || low < 0) fail(where, "uri has a % without two hexadecimal digits");
    text.push_back(static_cast<char>(high * 16 + low));
    i += 2;
  }
  if (text.find('\0') != std::string::npos) fail(where, "uri holds a zero byte");
  return text;
}

bool isInside(const fs::path& path, const fs::path& folder) {
  const auto end = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end.first == folder.end();
}

Bytes readDataUri(const std::string& uri, const std::string& where) {
  Bytes bytes;
  std::string mime_type;
  if (!tinygltf::IsDataURI(uri)) fail(where, "data: uri is of an unknown kind");
  if (!tinygltf::DecodeDataURI(&bytes, mime_type, uri, 0, false) || bytes.empty()) {
    fail(where, "data: uri holds no bytes");
  }
  return bytes;
}

}  // namespace

Bytes readFile(const fs::path& path, const std::string& where, std::int64_t largest_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail(where, "no such file");
  if (fs::is_directory(status)) fail(where, "is a directory, not a file");
  if (!fs::is_regular_file(status)) fail(where, "is not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) fail(where, "cannot be read");
  if (size > static_cast<std::uintmax_t>(largest_bytes)) {
    fail(where, "is larger than " + std::to_string(largest_bytes >> 20) + " MiB");
  }
  Bytes bytes(size);
  std::ifstream stream(path, std::ios::binary);
  // A file that shrinks meanwhile is caught here; one that grows is cut at what was allowed.
  if (!stream || !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    fail(where, "cannot be read");
  }
  return bytes;
}

Document readDocument(const fs::path& path) {
  Document document;
  document.file = path.filename().string();
  if (document.file.empty()) document.file = path.string();
  const Bytes bytes = readFile(path, document.file);
  std::error_code error;
  document.folder = fs::canonical(path, error).parent_path();
  if (error) fail(document.file, "cannot be read");
  if (bytes.empty()) fail(document.file, "is empty");
  if (bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0) {
    readGlb(bytes, document);
  } else {
    document.json = parseJson(bytes.data(), bytes.size(), document.file);
  }
  return document;
}

Bytes readUri(const std::string& uri, const fs::path& folder, const std::string& where) {
  if (uri.empty()) fail(where, "uri is empty");
  if (uri.starts_with("data:")) return readDataUri(uri, where);
  const std::string shown = where + ": uri \"" + (uri.size() > 80 ? uri.substr(0, 80) + "..." : uri) + "\"";
  std::error_code error;
  const fs::path path = fs::canonical(folder / percentDecoded(uri, where), error);
  if (error) fail(shown, "no such file");
  if (!isInside(path, folder)) fail(shown, "lies outside the model's folder");
  return readFile(path, shown);
}

}  // namespace host::gltf
