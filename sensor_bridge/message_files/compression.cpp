// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/message_files/compression.hpp"

#include <algorithm>
#include <bzlib.h>
#include <lz4frame.h>
#include <memory>
#include <zstd.h>

namespace quoin::sensor_bridge {

namespace {

constexpr int zstd_level = 1;  // the fastest: a recorder runs on the robot

/// Output that grows as it is filled, up to what the recording promises.
class Filled {
 public:
  Filled(std::size_t size, std::string& out) : size_(size), out_(out) { out_.clear(); }

  /// Room for what comes next. None is left when the promised size is reached.
  [[nodiscard]] std::pair<char*, std::size_t> room() {
    constexpr std::size_t first = std::size_t{1} << 16U;
    if (used_ == out_.size() && used_ < size_) {
      out_.resize(std::min(size_, std::max(first, 2 * out_.size())));
    }
    return {out_.data() + used_, out_.size() - used_};
  }
  void add(std::size_t count) { used_ += count; }
  [[nodiscard]] bool full() const { return used_ == size_; }
  void finish() {
    out_.resize(used_);
    if (used_ != size_) {
      throw CompressionError("it holds " + std::to_string(used_) + " bytes where " +
                             std::to_string(size_) + " are promised");
    }
  }

 private:
  std::size_t size_;
  std::string& out_;
  std::size_t used_ = 0;
};

[[noreturn]] void too_much(std::size_t size) {
  throw CompressionError("it holds more than the " + std::to_string(size) +
                         " bytes that are promised");
}

void decompress_zstd(std::string_view bytes, std::size_t size, Filled& out) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(),
                                                                        ZSTD_freeDCtx);
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  while (true) {
    const auto [begin, capacity] = out.room();
    ZSTD_outBuffer buffer{begin, capacity, 0};
    const std::size_t before = in.pos;
    const std::size_t left = ZSTD_decompressStream(context.get(), &buffer, &in);
    if (ZSTD_isError(left) != 0) throw CompressionError(ZSTD_getErrorName(left));
    out.add(buffer.pos);
    if (left == 0 && in.pos == in.size) return;
    if (buffer.pos == 0 && in.pos == before) {
      if (out.full()) too_much(size);
      throw CompressionError("it ends in the middle");
    }
  }
}

void decompress_lz4(std::string_view bytes, std::size_t size, Filled& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) {
    throw CompressionError("no memory");
  }
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(
      made, LZ4F_freeDecompressionContext);
  std::size_t at = 0;
  while (true) {
    const auto [begin, capacity] = out.room();
    std::size_t written = capacity;
    std::size_t read = bytes.size() - at;
    const std::size_t left =
        LZ4F_decompress(context.get(), begin, &written, bytes.data() + at, &read, nullptr);
    if (LZ4F_isError(left) != 0) throw CompressionError(LZ4F_getErrorName(left));
    out.add(written);
    at += read;
    if (left == 0 && at == bytes.size()) return;
    if (written == 0 && read == 0) {
      if (out.full()) too_much(size);
      throw CompressionError("it ends in the middle");
    }
  }
}

void decompress_bz2(std::string_view bytes, std::size_t size, Filled& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw CompressionError("no memory");
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> guard(&stream, BZ2_bzDecompressEnd);
  // bzlib only reads, but wants bytes that it could write.
  stream.next_in = const_cast<char*>(bytes.data());
  stream.avail_in = static_cast<unsigned>(bytes.size());
  while (true) {
    const auto [begin, capacity] = out.room();
    stream.next_out = begin;
    stream.avail_out = static_cast<unsigned>(capacity);
    const unsigned before = stream.avail_in;
    const int result = BZ2_bzDecompress(&stream);
    if (result != BZ_OK && result != BZ_STREAM_END) throw CompressionError("bz2 data is damaged");
    const std::size_t written = capacity - stream.avail_out;
    out.add(written);
    if (result == BZ_STREAM_END) return;
    if (written == 0 && stream.avail_in == before) {
      if (out.full()) too_much(size);
      throw CompressionError("it ends in the middle");
    }
  }
}

}  // namespace

std::optional<Compression> compression_of(std::string_view name) {
  if (name.empty() || name == "none") return Compression::none;
  if (name == "zstd") return Compression::zstd;
  if (name == "lz4") return Compression::lz4;
  if (name == "bz2") return Compression::bz2;
  return std::nullopt;
}

std::string_view compression_name(Compression compression) {
  return compression == Compression::zstd ? "zstd" : compression == Compression::lz4 ? "lz4" : "";
}

void compress(Compression compression, std::string_view bytes, std::string& out) {
  switch (compression) {
    case Compression::zstd: {
      out.resize(ZSTD_compressBound(bytes.size()));
      const std::size_t size =
          ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), zstd_level);
      if (ZSTD_isError(size) != 0) throw CompressionError(ZSTD_getErrorName(size));
      return out.resize(size);
    }
    case Compression::lz4: {
      out.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
      const std::size_t size =
          LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr);
      if (LZ4F_isError(size) != 0) throw CompressionError(LZ4F_getErrorName(size));
      return out.resize(size);
    }
    case Compression::none:
    case Compression::bz2:
      break;
  }
  out = bytes;
}

void decompress(Compression compression, std::string_view bytes, std::size_t size,
                std::string& out) {
  if (size > largest_chunk) {
    throw CompressionError("it promises " + std::to_string(size) + " bytes, more than the " +
                           std::to_string(largest_chunk) + " that a chunk may have");
  }
  if (compression == Compression::none) {
    if (bytes.size() != size) {
      throw CompressionError("it holds " + std::to_string(bytes.size()) + " bytes where " +
                             std::to_string(size) + " are promised");
    }
    out = bytes;
    return;
  }
  Filled filled(size, out);
  if (compression == Compression::zstd) decompress_zstd(bytes, size, filled);
  if (compression == Compression::lz4) decompress_lz4(bytes, size, filled);
  if (compression == Compression::bz2) decompress_bz2(bytes, size, filled);
  filled.finish();
}

}  // namespace quoin::sensor_bridge
