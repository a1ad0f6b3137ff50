// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include "services/runtime/dds/entities.hpp"
#include "services/runtime/dds/fast_dds.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;

namespace {

// [byte] What a place of a history has at first; it grows with the samples that it holds. The
// generated code would have it hold a hundred elements of every sequence, and 255 characters of
// every string: 66 kB for the corners of a scan, of which a room needs 2.
constexpr std::uint32_t smallest_sample = 512;

// [byte] Keys up to this size are the handle themselves, longer ones their MD5 (RTPS 2.2, 9.6.3.3).
constexpr std::size_t handle_size = 16;

const topics::RawMessage& raw(const CdrSample& sample) {
  return *static_cast<const topics::RawMessage*>(sample.message);
}

/// The number of bytes written; 0 when they do not fit.
std::size_t write_raw(const topics::RawMessage& message, std::byte* out, std::size_t capacity) {
  const std::size_t size = (message.cdr.size() + 3U) & ~std::size_t{3};
  if (size > capacity || !topics::is_plain_cdr(message.cdr.data(), message.cdr.size())) return 0;
  std::ranges::copy(message.cdr, out);
  std::fill(out + message.cdr.size(), out + size, std::byte{0});
  return size;
}

}  // namespace

CdrType::CdrType(const std::string& name, const topics::CdrCodec* codec)
    : key_codec_(codec != nullptr && codec->keyed ? codec : nullptr) {
#ifdef QUOIN_FAST_DDS_2
  setName(name.c_str());
  // With type propagation on, nested types crash Fast DDS 2.9's discovery server and Cyclone DDS
  // refuses to match. In version 3 types are propagated that were registered as type objects.
  auto_fill_type_information(false);
  auto_fill_type_object(false);
  m_typeSize = smallest_sample;
  m_isGetKeyDefined = keyed();
#else
  set_name(name);
  max_serialized_type_size = smallest_sample;
  is_compute_key_provided = keyed();
#endif
}

bool CdrType::write(const void* data, Payload& payload) {
  const auto& sample = *static_cast<const CdrSample*>(data);
  auto* out = reinterpret_cast<std::byte*>(payload.data);
  const std::size_t size =
      sample.codec != nullptr ? topics::encode(*sample.codec, sample.message, out, payload.max_size)
                              : write_raw(raw(sample), out, payload.max_size);
  if (size == 0) return false;
  payload.length = static_cast<std::uint32_t>(size);
  payload.encapsulation = out[1] == std::byte{0} ? CDR_BE : CDR_LE;
  return true;
}

bool CdrType::read(const Payload& payload, void* data) {
  auto& sample = *static_cast<CdrSample*>(data);
  const auto* in = reinterpret_cast<const std::byte*>(payload.data);
  if (sample.codec != nullptr) {
    if (sample.check == nullptr) {
      return topics::decode(*sample.codec, in, payload.length, sample.message);
    }
    // DDS is to take it from the history in any case.
    sample.refusal = sample.check->refusal({in, payload.length});
    if (!sample.refusal && !topics::decode(*sample.codec, in, payload.length, sample.message)) {
      sample.refusal = "not of its type";
    }
    return true;
  }
  if (!topics::is_plain_cdr(in, payload.length)) return false;
  static_cast<topics::RawMessage*>(sample.message)->cdr.assign(in, in + payload.length);
  return true;
}

std::uint32_t CdrType::size_of(const void* data) {
  const auto& sample = *static_cast<const CdrSample*>(data);
  return static_cast<std::uint32_t>(sample.codec != nullptr
                                        ? topics::encoded_size(*sample.codec, sample.message)
                                        : (raw(sample).cdr.size() + 3U) & ~std::size_t{3});
}

bool CdrType::key_of_sample(const void* data, Handle& handle, bool force_md5) const {
  const auto& sample = *static_cast<const CdrSample*>(data);
  if (key_codec_ == nullptr) return false;
  if (sample.codec == key_codec_) return key_of(sample.message, handle, force_md5);
  if (sample.codec != nullptr) return false;
  return key_of_bytes(raw(sample).cdr.data(), raw(sample).cdr.size(), handle, force_md5);
}

// Whoever writes the bytes gives what was a message once.
bool CdrType::key_of_bytes(const std::byte* cdr, std::size_t size, Handle& handle,
                           bool force_md5) const {
  if (key_codec_ == nullptr) return false;
  const std::unique_ptr<void, void (*)(void*)> message(key_codec_->create(), key_codec_->destroy);
  return topics::decode(*key_codec_, cdr, size, message.get()) &&
         key_of(message.get(), handle, force_md5);
}

bool CdrType::key_of(const void* message, Handle& handle, bool force_md5) const {
  // The generated code has room for 255 characters of a string, and throws at longer ones.
  std::vector<char> key(
      std::max({key_codec_->key_size, key_codec_->size(message) + 8, handle_size}));
  eprosima::fastcdr::FastBuffer buffer(key.data(), key.size());
  eprosima::fastcdr::Cdr out(buffer, eprosima::fastcdr::Cdr::BIG_ENDIANNESS, fast_dds::xcdr1);
  try {
    key_codec_->serialize_key(message, out);
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;
  }
  const auto* bytes = reinterpret_cast<unsigned char*>(key.data());
  if (!force_md5 && key_codec_->key_size <= handle_size) {
    std::copy_n(bytes, handle_size, &handle.value[0]);
    return true;
  }
  fast_dds::Md5 md5;
  md5.init();
  md5.update(bytes, static_cast<unsigned int>(fast_dds::size_of(out)));
  md5.finalize();
  std::copy_n(md5.digest, handle_size, &handle.value[0]);
  return true;
}

void* CdrType::create() const {
  return key_codec_ != nullptr ? new CdrSample{key_codec_->create(), key_codec_}
                               : new CdrSample{new topics::RawMessage(), nullptr};
}

void CdrType::destroy(void* data) {
  auto* sample = static_cast<CdrSample*>(data);
  if (sample->codec != nullptr) {
    sample->codec->destroy(sample->message);
  } else {
    delete static_cast<topics::RawMessage*>(sample->message);
  }
  delete sample;
}

dds::TypeSupport type_support(const std::string& name, const topics::CdrCodec* codec) {
  return dds::TypeSupport(new CdrType(name, codec));
}

}  // namespace quoin::runtime
