#include "logging/session/packed_snapshot.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <zlib.h>

#include "engine/core/check.hpp"
#include "engine/world/participant_quantisation.hpp"

namespace septet::logging {
namespace {

constexpr std::byte packed_version{3};  // The wire's own bytes begin with 2.
constexpr std::uint8_t escape = 255;    // Marks a difference that lies behind the columns.
constexpr std::size_t most_column_bytes = max_wire_participants * participant_field_count * 11;

/// Prediction for the participants of `ids`; for new ones every field is 0.
std::vector<WireParticipant> expect(const std::vector<ParticipantId>& ids, const std::vector<WireParticipant>& moved_on,
                                    const ExpectationErrors& errors) {
  std::vector<WireParticipant> expected;
  expected.reserve(ids.size());
  auto known = moved_on.begin();
  auto error = errors.begin();
  for (const ParticipantId id : ids) {
    while (known != moved_on.end() && known->id < id) ++known;
    while (error != errors.end() && error->id < id) ++error;
    const bool is_new = known == moved_on.end() || known->id != id;
    WireParticipant& participant = expected.emplace_back(is_new ? WireParticipant{} : *known);
    participant.id = id;
    if (is_new || error == errors.end() || error->id != id) continue;
    for (std::size_t f = 0; f < ExpectationError::fields; ++f) {
      const auto [low, high] = participant_field_limits(field_position_x + f);
      std::int32_t& field = participant.fields[field_position_x + f];
      field = static_cast<std::int32_t>(
          std::clamp<std::int64_t>(std::int64_t{field} + error->steps[f], std::int64_t{low}, std::int64_t{high}));
    }
  }
  return expected;
}

/// Stores the error of `moved_on`, the wire's own prediction, for known participants.
void remember(const std::vector<WireParticipant>& now, const std::vector<WireParticipant>& moved_on,
              ExpectationErrors& errors) {
  errors.clear();
  auto known = moved_on.begin();
  for (const WireParticipant& participant : now) {
    while (known != moved_on.end() && known->id < participant.id) ++known;
    if (known == moved_on.end() || known->id != participant.id) continue;
    ExpectationError& error = errors.emplace_back();
    error.id = participant.id;
    for (std::size_t f = 0; f < ExpectationError::fields; ++f)
      error.steps[f] = std::int64_t{participant.fields[field_position_x + f]} - known->fields[field_position_x + f];
    // Another component has become the largest: the others are recoded, which predicts nothing for the next tick.
    if (participant.fields[field_largest] != known->fields[field_largest])
      std::fill(error.steps.begin() + (field_largest - field_position_x), error.steps.end(), 0);
  }
}

auto damaged(std::string what) { return failure(std::move(what), "snapshot", "the bytes are damaged"); }

bool is_packed(std::span<const std::byte> bytes) { return !bytes.empty() && bytes[0] == packed_version; }

/// The bytes of the wire within packed ones; empty if they end too early.
std::optional<std::span<const std::byte>> take_rest(ByteReader& reader) {
  reader.take(1);
  const auto rest = reader.take(reader.get_count(std::numeric_limits<std::uint32_t>::max()));
  return reader.ok() ? std::optional(rest) : std::nullopt;
}

/// Exactly the whole of it.
bool inflate_all(std::span<const std::byte> bytes, Bytes& out) {
  z_stream stream{};
  if (inflateInit2(&stream, -15) != Z_OK) return false;
  // zlib does not write there.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int result = inflate(&stream, Z_FINISH);
  const bool whole = result == Z_STREAM_END && stream.avail_in == 0 && stream.avail_out == 0;
  inflateEnd(&stream);
  return whole;
}

}  // namespace

struct SnapshotPacker::Deflate {
  z_stream stream{};

  Deflate() {
    // Runs and single letters: a third faster than searching, and here smaller.
    const int result = deflateInit2(&stream, 1, Z_DEFLATED, -15, 8, Z_RLE);
    SEPTET_CHECK(result == Z_OK, "zlib answers {}", result);
  }
  ~Deflate() { deflateEnd(&stream); }
  Deflate(const Deflate&) = delete;
  Deflate& operator=(const Deflate&) = delete;

  void append(const Bytes& bytes, Bytes& out) {
    deflateReset(&stream);
    const std::size_t begin = out.size();
    out.resize(begin + deflateBound(&stream, bytes.size()));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));  // zlib does not write there.
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + begin);
    stream.avail_out = static_cast<uInt>(out.size() - begin);
    const int result = deflate(&stream, Z_FINISH);
    SEPTET_CHECK(result == Z_STREAM_END, "zlib answers {}", result);
    out.resize(out.size() - stream.avail_out);
  }
};

SnapshotPacker::SnapshotPacker() : deflate_(std::make_unique<Deflate>()) {}
SnapshotPacker::SnapshotPacker(SnapshotPacker&&) noexcept = default;
SnapshotPacker& SnapshotPacker::operator=(SnapshotPacker&&) noexcept = default;
SnapshotPacker::~SnapshotPacker() = default;

void SnapshotPacker::pack(const WireSnapshot& wire, const WireSnapshot* baseline, Bytes& out) {
  if (!baseline) errors_.clear();
  rest_.clear();
  encode_without_participants(wire, baseline, rest_);
  ByteWriter writer(out);
  writer.put(static_cast<std::uint8_t>(packed_version));
  writer.put_varint(rest_.size());
  writer.put_bytes(rest_);

  std::vector<WireParticipant> moved_on;
  if (baseline) {
    moved_on.reserve(baseline->participants.size());
    const double seconds = seconds_since(*baseline, wire.rest.simulated_time_s);
    for (const auto& participant : baseline->participants) moved_on.push_back(extrapolate(participant, seconds));
  }
  const bool same_ids = std::ranges::equal(moved_on, wire.participants, {}, &WireParticipant::id, &WireParticipant::id);
  writer.put(static_cast<std::uint8_t>(same_ids ? 0 : 1));
  std::vector<ParticipantId> ids;
  ids.reserve(wire.participants.size());
  for (const auto& participant : wire.participants) ids.push_back(participant.id);
  if (!same_ids) {
    writer.put_varint(ids.size());
    ParticipantId next = 0;
    for (const ParticipantId id : ids) writer.put_varint(id - std::exchange(next, id + 1));
  }

  const std::vector<WireParticipant> expected = expect(ids, moved_on, errors_);
  columns_.clear();
  escapes_.clear();
  columns_.reserve(participant_field_count * ids.size());
  ByteWriter escapes(escapes_);
  for (std::size_t f = 0; f < participant_field_count; ++f)
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const std::uint64_t difference = zigzag(std::int64_t{wire.participants[i].fields[f]} - expected[i].fields[f]);
      columns_.push_back(static_cast<std::byte>(std::min<std::uint64_t>(difference, escape)));
      if (difference >= escape) escapes.put_varint(difference - escape);
    }
  columns_.insert(columns_.end(), escapes_.begin(), escapes_.end());
  writer.put_varint(columns_.size());
  if (!columns_.empty()) deflate_->append(columns_, out);
  remember(wire.participants, moved_on, errors_);
}

Expected<SnapshotHeader> read_stored_header(std::span<const std::byte> bytes) {
  if (!is_packed(bytes)) return read_snapshot_header(bytes);
  ByteReader reader(bytes);
  const auto rest = take_rest(reader);
  if (!rest) return damaged("unreadable header");
  return read_snapshot_header(*rest);
}

Expected<WireSnapshot> SnapshotUnpacker::unpack(std::span<const std::byte> bytes, const WireSnapshot* baseline) {
  if (!baseline) errors_.clear();
  if (!is_packed(bytes)) return decode_snapshot(bytes, baseline);
  ByteReader reader(bytes);
  const auto rest = take_rest(reader);
  if (!rest) return damaged("unreadable header");
  auto wire = decode_snapshot(*rest, baseline);  // Its participants are the baseline's, moved on.
  if (!wire) return wire;
  const std::vector<WireParticipant> moved_on = std::exchange(wire->participants, {});

  std::vector<ParticipantId> ids;
  const auto kind = reader.get<std::uint8_t>();
  if (kind == 0) {
    for (const auto& participant : moved_on) ids.push_back(participant.id);
  } else if (kind == 1) {
    const std::size_t count = reader.get_count(max_wire_participants);
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < count && reader.ok(); ++i) {
      const std::uint64_t gap = reader.get_varint();
      if (gap > std::numeric_limits<ParticipantId>::max() || next + gap > std::numeric_limits<ParticipantId>::max()) {
        reader.fail();
        break;
      }
      ids.push_back(static_cast<ParticipantId>(next + gap));
      next += gap + 1;
    }
  } else {
    reader.fail();
  }
  const std::size_t size = reader.get_count(most_column_bytes);
  const std::size_t cells = participant_field_count * ids.size();
  if (!reader.ok() || size < cells || (cells == 0 && size > 0)) return damaged("malformed participants");
  columns_.resize(size);
  const auto packed = reader.take(reader.remaining());
  if (size > 0 ? !inflate_all(packed, columns_) : !packed.empty()) return damaged("participants that do not unpack");

  std::vector<WireParticipant> expected = expect(ids, moved_on, errors_);
  ByteReader escapes{std::span<const std::byte>(columns_).subspan(cells)};
  for (std::size_t f = 0; f < participant_field_count; ++f) {
    const auto [low, high] = participant_field_limits(f);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      std::uint64_t difference = static_cast<std::uint8_t>(columns_[f * ids.size() + i]);
      if (difference == escape) difference += escapes.get_varint();
      if (difference > 0x1'ffff'ffffu) escapes.fail();  // More than any field differs.
      if (!escapes.ok()) return damaged("a field out of bounds");
      const auto steps = static_cast<std::int64_t>(difference >> 1) ^ -static_cast<std::int64_t>(difference & 1);
      const std::int64_t sum = std::int64_t{expected[i].fields[f]} + steps;
      if (sum < low || sum > high) return damaged("a field out of bounds");
      expected[i].fields[f] = static_cast<std::int32_t>(sum);
    }
  }
  if (!escapes.at_end()) return damaged("malformed participants");
  for (const auto& participant : expected)
    if (static_cast<std::size_t>(participant.fields[field_model]) >= vehicle_models().size())
      return damaged("a vehicle of no model");
  wire->participants = std::move(expected);
  remember(wire->participants, moved_on, errors_);
  return wire;
}

}  // namespace septet::logging
