// How a state is written to bytes and read from them: one list of fields for both ways. What is saved has
// `template <class Archive, class Self> static void visit(Archive& a, Self& self)`, or a free visitSaved()
// beside it, which names its fields to the archive. Little-endian, without gaps, whatever the machine.
//
// Nothing that is read is trusted: each number is finite and in its range, or the reader throws Refused.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rg::saved {

// What is wrong with a saved state.
class Refused : public std::invalid_argument {
 public:
  explicit Refused(const std::string& what) : std::invalid_argument("saved state: " + what) {}
};

// A parameter of visitSaved(): `Is<Pose> auto& pose` is of that type, const or not.
template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

inline constexpr double kMostByDefault = 1e9;  // of numbers with a fraction, either way

namespace detail {
template <class T>
inline constexpr bool is_vector = false;
template <glm::length_t L, class T, glm::qualifier Q>
inline constexpr bool is_vector<glm::vec<L, T, Q>> = true;
template <glm::length_t C, glm::length_t R, class T, glm::qualifier Q>
inline constexpr bool is_vector<glm::mat<C, R, T, Q>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;
template <class T>
struct Bits {
  using Type = std::make_unsigned_t<T>;
};
template <>
struct Bits<float> {
  using Type = uint32_t;
};
template <>
struct Bits<double> {
  using Type = uint64_t;
};
}  // namespace detail

// What both ways have in common: how things are made up of numbers.
template <class Self>
class Archive {
 public:
  template <class... T>
  void operator()(T&... things) {
    (one(things, -kMostByDefault, kMostByDefault), ...);
  }
  // Numbers, or things made up of them, from `least` to `most`.
  template <class T, class L, class M>
  void within(T& thing, L least, M most) {
    one(thing, least, most);
  }
  // At most `most` things; each(thing) for each of them.
  template <class List, class F>
  void list(List& things, size_t most, F&& each) {
    self().items(things, most, each);
  }
  template <class List>
  void list(List& things, size_t most) {
    list(things, most, [this](auto& thing) { (*this)(thing); });
  }
  template <class List>
  void listWithin(List& things, size_t most, double least_value, double most_value) {
    list(things, most, [&](auto& thing) { within(thing, least_value, most_value); });
  }
  // Of a pair.
  template <class P>
  void both(P& pair) {
    (*this)(pair.first, pair.second);
  }

 private:
  Self& self() { return static_cast<Self&>(*this); }

  template <class T, class L, class M>
  void one(T& thing, L least, M most) {
    using Plain = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Plain, bool>) {
      self().flag(thing);
    } else if constexpr (std::is_floating_point_v<Plain>) {
      self().real(thing, static_cast<double>(least), static_cast<double>(most));
    } else if constexpr (std::is_integral_v<Plain>) {
      // The default range is of numbers with a fraction.
      if constexpr (std::is_floating_point_v<L>)
        self().whole(thing, std::numeric_limits<Plain>::min(), std::numeric_limits<Plain>::max());
      else
        self().whole(thing, static_cast<Plain>(least), static_cast<Plain>(most));
    } else if constexpr (detail::is_vector<Plain>) {
      for (glm::length_t i = 0; i < Plain::length(); ++i) one(thing[i], least, most);
    } else if constexpr (detail::is_array<Plain>) {
      for (auto& item : thing) one(item, least, most);
    } else if constexpr (requires(Self & a) { Plain::visit(a, thing); }) {
      Plain::visit(self(), thing);
    } else {
      visitSaved(self(), thing);
    }
  }
};

class Writer : public Archive<Writer> {
 public:
  static constexpr bool kReads = false;
  std::vector<unsigned char> bytes;

  void flag(bool value) { bytes.push_back(value ? 1 : 0); }
  void real(float value, double, double) { put(std::bit_cast<uint32_t>(value)); }
  void real(double value, double, double) { put(std::bit_cast<uint64_t>(value)); }
  template <class T>
  void whole(T value, T, T) {
    put(static_cast<std::make_unsigned_t<T>>(value));
  }
  template <class List, class F>
  void items(List& things, size_t, F& each) {
    put(static_cast<uint32_t>(things.size()));
    for (auto& thing : things) each(thing);
  }
  // Seven bits a byte, the lowest first.
  void packed(uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<unsigned char>(value | 0x80));
    bytes.push_back(static_cast<unsigned char>(value));
  }
  void text(const std::string& value, size_t) {
    put(static_cast<uint32_t>(value.size()));
    bytes.insert(bytes.end(), value.begin(), value.end());
  }

 private:
  template <class U>
  void put(U value) {
    for (size_t i = 0; i < sizeof(U); ++i)
      bytes.push_back(static_cast<unsigned char>(static_cast<uint64_t>(value) >> (8 * i)));
  }
};

class Reader : public Archive<Reader> {
 public:
  static constexpr bool kReads = true;
  // One that does not commit only looks whether all is well: who reads from it changes nothing then.
  Reader(std::span<const unsigned char> bytes, bool commits) : rest_(bytes), commits_(commits) {}

  bool commits() const { return commits_; }
  size_t left() const { return rest_.size(); }
  // What is read now, for messages.
  void enter(const std::string& part) { part_ = part; }
  [[noreturn]] void refuse(const std::string& what) const { throw Refused(part_ + ": " + what); }
  void require(bool met, const char* what) const {
    if (!met) refuse(what);
  }

  void flag(bool& value) {
    const auto byte = take<uint8_t>();
    require(byte <= 1, "a flag is neither set nor clear");
    value = byte != 0;
  }
  template <class T>
  void real(T& value, double least, double most) {
    value = std::bit_cast<T>(take<typename detail::Bits<T>::Type>());
    const auto wide = static_cast<double>(value);
    require(wide >= least && wide <= most, "a number is out of range");  // as is one that is none
  }
  template <class T>
  void whole(T& value, T least, T most) {
    value = static_cast<T>(take<std::make_unsigned_t<T>>());
    require(value >= least && value <= most, "a number is out of range");
  }
  // Room is made as things are read: however many there are said to be, it is in proportion to the bytes
  // there are.
  template <class List, class F>
  void items(List& things, size_t most, F& each) {
    const size_t count = take<uint32_t>();
    require(count <= most && count <= left(), "a list is too long");  // each takes a byte at least
    things.clear();
    if constexpr (requires { things.reserve(count); })
      things.reserve(std::min(count, left() / sizeof(typename List::value_type)));
    while (things.size() < count) each(things.emplace_back());
  }
  uint64_t packed() {
    uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = take<uint8_t>();
      value |= static_cast<uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    refuse("a packed number does not end");
  }
  void text(std::string& value, size_t most) {
    const size_t count = take<uint32_t>();
    require(count <= most && count <= left(), "a text is too long");
    value.assign(reinterpret_cast<const char*>(rest_.data()), count);
    rest_ = rest_.subspan(count);
  }
  std::span<const unsigned char> part(size_t bytes) {
    require(bytes <= left(), "it ends early");
    const auto taken = rest_.first(bytes);
    rest_ = rest_.subspan(bytes);
    return taken;
  }

 private:
  template <class U>
  U take() {
    require(rest_.size() >= sizeof(U), "it ends early");
    uint64_t value = 0;
    for (size_t i = 0; i < sizeof(U); ++i) value |= static_cast<uint64_t>(rest_[i]) << (8 * i);
    rest_ = rest_.subspan(sizeof(U));
    return static_cast<U>(value);
  }

  std::span<const unsigned char> rest_;
  bool commits_;
  std::string part_ = "header";
};

// A long row of whole numbers, small where a number takes few bits or is the one before. After two that are
// alike comes how many more are.
template <class T>
void writeRow(Writer& a, std::span<const T> row) {
  for (size_t i = 0; i < row.size();) {
    a.packed(row[i]);
    if (i == 0 || row[i] != row[i - 1]) {
      ++i;
      continue;
    }
    size_t end = i + 1;
    while (end < row.size() && row[end] == row[i]) ++end;
    a.packed(end - i - 1);
    i = end;
  }
}

template <class T>
void readRow(Reader& a, std::span<T> row) {
  const auto next = [&a] {
    const uint64_t value = a.packed();
    a.require(value <= std::numeric_limits<T>::max(), "a number is out of range");
    return static_cast<T>(value);
  };
  for (size_t i = 0; i < row.size();) {
    row[i] = next();
    if (i == 0 || row[i] != row[i - 1]) {
      ++i;
      continue;
    }
    const uint64_t more = a.packed();
    a.require(more <= row.size() - i - 1, "a run is too long");
    std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(i) + 1, more, row[i]);
    i += 1 + more;
  }
}

// FNV-1a over words of 8 bytes and a rest: told apart are states that differ, not forgeries.
class Fingerprint {
 public:
  void add(std::span<const unsigned char> bytes) {
    size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
      uint64_t word = 0;
      for (size_t k = 0; k < 8; ++k) word |= static_cast<uint64_t>(bytes[i + k]) << (8 * k);
      mix(word);
    }
    for (; i < bytes.size(); ++i) mix(bytes[i]);
  }
  uint64_t value() const { return value_; }

 private:
  void mix(uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3ull;
    value_ ^= value_ >> 29;
  }
  uint64_t value_ = 0xcbf29ce484222325ull;
};

inline uint64_t fingerprintOf(std::span<const unsigned char> bytes) {
  Fingerprint f;
  f.add(bytes);
  return f.value();
}

}  // namespace rg::saved
