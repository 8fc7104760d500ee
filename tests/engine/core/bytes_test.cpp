#include "engine/core/bytes.hpp"

#include <cstdint>
#include <limits>

#include <doctest/doctest.h>

namespace septet {

TEST_CASE("what the writer puts the reader gets") {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.put<std::uint16_t>(0xbeef);
  writer.put(-1.25);
  writer.put_varint(300);
  writer.put_signed_varint(std::numeric_limits<std::int64_t>::min());
  writer.put_string("yaw rate");

  ByteReader reader(bytes);
  CHECK(reader.get<std::uint16_t>() == 0xbeef);
  CHECK(reader.get_double() == -1.25);
  CHECK(reader.get_varint() == 300);
  CHECK(reader.get_signed_varint() == std::numeric_limits<std::int64_t>::min());
  CHECK(reader.get_string(20) == "yaw rate");
  CHECK(reader.ok());
  CHECK(reader.at_end());
}

TEST_CASE("reading past the end fails and answers zero ever after") {
  const Bytes bytes(3, std::byte{0xff});
  ByteReader reader(bytes);
  CHECK(reader.get<std::uint32_t>() == 0);
  CHECK_FALSE(reader.ok());
  CHECK(reader.get<std::uint8_t>() == 0);
}

TEST_CASE("a varint longer than ten bytes or 64 bits is refused") {
  const Bytes endless(11, std::byte{0xff});
  ByteReader reader(endless);
  CHECK(reader.get_varint() == 0);
  CHECK_FALSE(reader.ok());
}

TEST_CASE("a count over its limit is refused") {
  Bytes bytes;
  ByteWriter(bytes).put_varint(1000);
  ByteReader reader(bytes);
  CHECK(reader.get_count(999) == 0);
  CHECK_FALSE(reader.ok());
}

}  // namespace septet
