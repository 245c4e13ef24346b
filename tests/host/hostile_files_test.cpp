// What lies around a document: paths, containers, bytes turned at random. Each loads or is refused; nothing
// else happens.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <random>

#include "gltf_files.h"
#include "loaded.h"
#include "scene/scene.h"

namespace {

using files::Bytes;
using files::complaint;
using files::Gltf;
using files::Json;
using files::TempFolder;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A whole car in `model/car.gltf`, its image from `uri`; what loading says.
std::string complaintWithImage(const TempFolder& folder, const std::string& uri) {
  Gltf g = files::wholeCar();
  g.json["images"][0] = {{"name", "paint"}, {"uri", uri}};
  folder.write("model/buffer.bin", g.bin);
  return complaint(folder.write("model/car.gltf", g.gltf()));
}

TEST(HostileFiles, imageBesideTheModelLoads) {
  const TempFolder folder;
  folder.write("model/a b.png", files::tinyPng());
  folder.write("model/textures/c.png", files::tinyPng());
  EXPECT_EQ(complaintWithImage(folder, "a%20b.png"), "");
  EXPECT_EQ(complaintWithImage(folder, "textures/c.png"), "");
  EXPECT_EQ(complaintWithImage(folder, "textures/../a b.png"), "") << "dots that stay inside are no harm";
}

TEST(HostileFiles, nothingOutsideTheModelsFolderIsRead) {
  const TempFolder folder;
  folder.write("outside.png", files::tinyPng());
  folder.write("model_too/outside.png", files::tinyPng());  // the folder's name is a prefix of this one
  std::filesystem::create_directories(folder / "model");
  std::filesystem::create_symlink(folder / "outside.png", folder / "model/link.png");
  std::filesystem::create_directory_symlink(folder / "model_too", folder / "model/linked");
  const std::vector<std::string> uris = {"../outside.png",
                                         "%2e%2e/outside.png",
                                         "textures/../../outside.png",
                                         "../model_too/outside.png",
                                         "link.png",
                                         "linked/outside.png",
                                         (folder / "outside.png").string(),
                                         "/etc/passwd",
                                         "file:///etc/passwd"};
  for (const std::string& uri : uris) {
    const std::string message = complaintWithImage(folder, uri);
    EXPECT_EQ(message.rfind("car.gltf: image 0 \"paint\": uri ", 0), 0U) << uri << ": " << message;
    EXPECT_TRUE(contains(message, "outside the model's folder") || contains(message, "no such file"))
        << message;
  }
}

TEST(HostileFiles, uriThatNamesNoFileIsRefused) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "model/dir.png");
  ASSERT_EQ(mkfifo((folder / "model/pipe.png").c_str(), 0600), 0);
  folder.write("model/empty.png", Bytes{});
  EXPECT_TRUE(
      contains(complaintWithImage(folder, "dir.png"), "image 0 \"paint\": uri \"dir.png\": is a directory"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "."), "is a directory"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "pipe.png"), "not a regular file"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "missing.png"), "no such file"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "empty.png"), "image 0 \"paint\": is an empty file"));
  EXPECT_TRUE(contains(complaintWithImage(folder, ""), "image 0 \"paint\": uri is empty"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "a%00b.png"), "zero byte"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "a%2"), "two hexadecimal digits"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "a%zz"), "two hexadecimal digits"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "car.gltf"), "neither PNG nor JPEG"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "http://example.org/a.png"), "no such file"));
  EXPECT_TRUE(contains(complaintWithImage(folder, std::string(100'000, 'a')), "no such file"));
}

TEST(HostileFiles, dataUrisAreReadAndChecked) {
  const TempFolder folder;
  const std::string png =
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGM4kWIEAANWAV/oF4RSAAAAAElFTkSuQmCC";
  EXPECT_EQ(complaintWithImage(folder, "data:image/png;base64," + png), "");
  EXPECT_TRUE(contains(complaintWithImage(folder, "data:image/png;base64,"),
                       "image 0 \"paint\": data: uri holds no bytes"));
  EXPECT_TRUE(
      contains(complaintWithImage(folder, "data:image/png;base64,####"), "image 0 \"paint\": data: uri"));
  EXPECT_TRUE(
      contains(complaintWithImage(folder, "data:text/html,hello"), "data: uri is of an unknown kind"));
  EXPECT_TRUE(contains(complaintWithImage(folder, "data:image/png;base64,QUJD"), "neither PNG nor JPEG"));
}

TEST(HostileFiles, modelThatIsNoFileIsRefused) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "dir.glb");
  ASSERT_EQ(mkfifo((folder / "pipe.glb").c_str(), 0600), 0);
  EXPECT_EQ(complaint(folder / "dir.glb"), "dir.glb: is a directory, not a file");
  EXPECT_EQ(complaint(folder / "pipe.glb"), "pipe.glb: is not a regular file");
  EXPECT_EQ(complaint(folder / "none.glb"), "none.glb: no such file");
  EXPECT_EQ(complaint(folder.write("empty.glb", Bytes{})), "empty.glb: is empty");
}

TEST(HostileFiles, brokenJsonIsRefused) {
  const TempFolder folder;
  for (const char* text :
       {"{", "[]", "null", "7", "\"\"", "{\"asset\":}", "{\"asset\":{\"version\":\"2.0\"},}", "\xff\xfe",
        "glT", "{\"asset\":{\"version\":\"2.0\"},\"x\":NaN}",
        "{\"asset\":{\"version\":\"2.0\"},\"x\":1e999}"}) {
    const std::string message = complaint(folder.write("a.gltf", std::string(text)));
    EXPECT_EQ(message.rfind("a.gltf: ", 0), 0U) << text;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_TRUE(contains(complaint(folder.write("deep.gltf", std::string(5'000'000, '['))),
                       "deep.gltf: its JSON is nested deeper"));
}

TEST(HostileFiles, namesCannotBreakTheLine) {
  Gltf g = files::wholeCar();
  g.json["nodes"][1]["name"] = "a\nb\x1b[31m" + std::string(5000, 'x');
  g.json["nodes"][1]["extras"]["rainglass"]["arm_m"] = 9;
  const TempFolder folder;
  const std::string message = complaint(folder.write("car.glb", g.glb()));
  EXPECT_TRUE(contains(message, "node 1 \"a?b?[31mxxx")) << message;
  EXPECT_TRUE(contains(message, "arm_m is 9")) << message;
  EXPECT_LT(message.size(), 600U);
}

struct Container {
  const char* what;
  std::size_t at;  ///< of a 32 bit number in the file
  std::uint32_t value;
  const char* expected;
};

TEST(HostileFiles, binaryContainerThatLiesIsRefused) {
  const Bytes sound = files::wholeCar().glb();
  std::uint32_t json_bytes = 0;
  std::memcpy(&json_bytes, sound.data() + 12, 4);
  const std::size_t bin = 20 + json_bytes;
  const std::vector<Container> cases = {
      {"version 1", 4, 1, "binary header: version is 1"},
      {"length too long", 8, 0x7fffffff, "binary header: length"},
      {"length too short", 8, 100, "binary header: length"},
      {"first chunk too long", 12, 0xfffffff0, "chunk at byte 12 claims 4294967280 bytes"},
      {"first chunk too short", 12, 40, "is not valid JSON"},
      {"first chunk of other kind", 16, 0x004E4942, "first binary chunk is not JSON"},
      {"second chunk too long", bin, 0xffffffff, "claims 4294967295 bytes"},
      {"second chunk too short", bin, 4, "buffer 0: byteLength"},
      {"second chunk of other kind", bin + 4, 1, "buffer 0: has no uri"}};
  const TempFolder folder;
  for (const Container& c : cases) {
    Bytes bytes = sound;
    std::memcpy(bytes.data() + c.at, &c.value, 4);
    const std::string message = complaint(folder.write("car.glb", bytes));
    EXPECT_TRUE(contains(message, c.expected)) << c.what << ": " << message;
    EXPECT_EQ(message.rfind("car.glb: ", 0), 0U) << message;
  }
}

TEST(HostileFiles, everyTruncationIsRefused) {
  const Bytes sound = files::wholeCar().glb();
  const TempFolder folder;
  for (std::size_t size = 0; size < sound.size(); size += size < 64 ? 1 : 97) {
    const Bytes cut(sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(complaint(folder.write("car.glb", cut)), "") << size;
  }
}

TEST(HostileFiles, hugeImageIsRefusedBeforeItIsDecoded) {
  // 60000 x 60000 in a whole IHDR with a right checksum.
  Bytes png = files::tinyPng();
  const Bytes header = {0x00, 0x00, 0xea, 0x60, 0x00, 0x00, 0xea, 0x60, 0x08,
                        0x02, 0x00, 0x00, 0x00, 0x0f, 0xb0, 0xe2, 0x15};
  std::copy(header.begin(), header.end(), png.begin() + 16);
  const TempFolder folder;
  folder.write("model/bomb.png", png);
  const std::string message = complaintWithImage(folder, "bomb.png");
  EXPECT_TRUE(contains(message, "image is 60000 x 60000 pixels")) << message;
}

/// Turns a few bytes, or cuts or doubles a stretch.
void mutate(Bytes& bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::size_t times = 1 + below(4);
  for (std::size_t i = 0; i < times && bytes.size() > 8; ++i) {
    const std::size_t at = below(bytes.size());
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(6)) {
      case 0:
        *place = static_cast<std::uint8_t>(below(256));
        break;
      case 1:
        *place = static_cast<std::uint8_t>(*place ^ (1U << below(8)));
        break;
      case 2:  // numbers in the text: -, 9 and e make the most harm
        *place = static_cast<std::uint8_t>("-9e0.[]{}\""[below(10)]);
        break;
      case 3:
        bytes.erase(place, place + static_cast<std::ptrdiff_t>(
                                       std::min<std::size_t>(1 + below(8), bytes.size() - at)));
        break;
      case 4:
        bytes.insert(place, static_cast<std::uint8_t>("0123456789"[below(10)]));
        break;
      default:
        for (std::size_t k = at; k < std::min(at + 4, bytes.size()); ++k) bytes[k] = 0xff;
    }
  }
}

/// Loads thousands of variants; what is refused is refused in one line. Returns how many still load.
int loadVariants(const TempFolder& folder, const char* name, const Bytes& sound, unsigned seed,
                 int variants) {
  std::mt19937 random(seed);
  int loaded = 0;
  for (int i = 0; i < variants; ++i) {
    Bytes bytes = sound;
    mutate(bytes, random);
    const std::string message = complaint(folder.write(name, bytes));
    loaded += message.empty() ? 1 : 0;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(message.empty() || message.rfind(std::string(name) + ": ", 0) == 0) << message;
  }
  return loaded;
}

TEST(HostileFiles, randomDamageLoadsOrIsRefused) {
  const Gltf g = files::wholeCar();
  const TempFolder folder;
  folder.write("buffer.bin", g.bin);
  const std::string text = g.gltf();
  constexpr int kVariants = 1500;
  const int binary = loadVariants(folder, "car.glb", g.glb(), 1, kVariants);
  const int plain = loadVariants(folder, "car.gltf", Bytes(text.begin(), text.end()), 2, kVariants);
  EXPECT_GT(binary + plain, 0)
      << "some damage is harmless (a turned vertex): else the test tests only the first check";
  EXPECT_LT(binary + plain, 2 * kVariants);
}

TEST(HostileFiles, damagedNumbersLoadOrAreRefused) {
  // Structure intact, one number anywhere replaced: reaches far behind the parser.
  const Json sound = files::wholeCar().json.flatten();
  const std::vector<Json> values = {-1,          0,    1,      3,   255, 1 << 20, 0x7fffffff,
                                    0xffffffffU, 1e30, -1e300, 0.5, "x", nullptr, true};
  const TempFolder folder;
  Gltf g = files::wholeCar();
  std::size_t turn = 0;  // each number gets five of the values, and neighbours others
  int refused = 0;
  for (const auto& item : sound.items()) {
    for (std::size_t i = 0; i < 5; ++i) {
      const Json& value = values[(turn += 3) % values.size()];
      Json flat = sound;
      flat[item.key()] = value;
      g.json = flat.unflatten();
      const std::string message = complaint(folder.write("car.glb", g.glb()));
      refused += message.empty() ? 0 : 1;
      EXPECT_TRUE(message.empty() || message.rfind("car.glb: ", 0) == 0) << item.key() << ": " << message;
      EXPECT_EQ(message.find("tinygltf"), std::string::npos)
          << item.key() << " = " << value << " got past the checks: " << message;
    }
  }
  EXPECT_GT(refused, static_cast<int>(sound.size()));
}

}  // namespace
