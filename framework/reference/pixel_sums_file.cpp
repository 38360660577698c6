// SPDX-License-Identifier: MIT
// PixelSums as bytes: what a run that was interrupted leaves behind, and what shards send home.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <string_view>

#include "framework/core/content_hash.h"
#include "framework/core/error.h"
#include "framework/image/image_limits.h"
#include "framework/reference/pixel_sums.h"

namespace kaustik::reference {
namespace {

constexpr std::string_view kMagic = "kaustik.sums/3\n";
constexpr std::size_t kHashDigits = 32;
// Sums of as many fit into 128 bits (framework/reference/pixel_sums.cpp).
constexpr std::uint64_t kMaxBatches = 1u << 22;
constexpr int kMaxBits = 126;
constexpr int kMaxLayers = 128;

class Writer {
  public:
    template <class T>
    void put(const T& value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    template <class T>
    void putAll(const std::vector<T>& values) {
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }
    void putText(std::string_view text) { bytes_.append(text); }
    [[nodiscard]] std::string finish() {
        bytes_ += ContentHash().addBytes(bytes_).hex();
        return std::move(bytes_);
    }

  private:
    std::string bytes_;
};

class Reader {
  public:
    Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw IoError(fmt::format("{} is no usable state of a reference: {}.", name_, what));
    }
    std::string_view take(std::size_t size) {
        if (size > bytes_.size()) fail("it ends too early");
        const std::string_view part = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return part;
    }
    template <class T>
    T get() {
        T value{};
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    template <class T>
    void getAll(std::vector<T>& values) {
        const std::string_view part = take(values.size() * sizeof(T));
        if (!values.empty()) std::memcpy(values.data(), part.data(), part.size());
    }
    [[nodiscard]] bool isAtEnd() const { return bytes_.empty(); }

  private:
    std::string_view bytes_;
    const std::string& name_;
};

// Sorted, apart from each other, and no more than may be.
void requireBatches(const std::vector<BatchRange>& batches, const Reader& reader) {
    std::uint64_t count = 0;
    std::uint64_t end = 0;
    for (const BatchRange& range : batches) {
        const bool isNext = count == 0 || range.first > end;
        if (!isNext || range.end <= range.first || range.end - range.first > kMaxBatches - count)
            reader.fail("its batches make no sense");
        count += range.end - range.first;
        end = range.end;
    }
}

}  // namespace

std::string PixelSums::toBytes(const std::string& key) const {
    Writer writer;
    writer.putText(kMagic);
    writer.put(static_cast<std::uint64_t>(key.size()));
    writer.putText(key);
    for (const int number : {width_, height_, layers_})
        writer.put(number);
    writer.put(quantum_);
    writer.put(energyQuantum_);
    for (const std::uint64_t count : {photons_, rays_, rejectedValues_, batches_.size()})
        writer.put(count);
    writer.putAll(batches_);
    writer.put(energy_);
    writer.putAll(sums_);
    writer.putAll(squares_);
    return writer.finish();
}

PixelSums PixelSums::fromBytes(std::string_view bytes, const std::string& key,
                               const std::string& name) {
    Reader reader(bytes, name);
    if (!bytes.starts_with(kMagic)) reader.fail("it does not begin like one of this version");
    if (bytes.size() < kMagic.size() + kHashDigits) reader.fail("it ends too early");
    const std::string_view content = bytes.substr(0, bytes.size() - kHashDigits);
    if (ContentHash().addBytes(content).hex() != bytes.substr(content.size()))
        reader.fail("its checksum is wrong");
    reader.take(kMagic.size());
    const auto keySize = reader.get<std::uint64_t>();
    if (reader.take(keySize) != key) {
        throw ConfigError(fmt::format(
            "{} belongs to another scene or to other settings; delete it or name another file.",
            name));
    }
    PixelSums sums;
    sums.width_ = reader.get<int>();
    sums.height_ = reader.get<int>();
    sums.layers_ = reader.get<int>();
    sums.quantum_ = reader.get<double>();
    sums.energyQuantum_ = reader.get<double>();
    sums.photons_ = reader.get<std::uint64_t>();
    sums.rays_ = reader.get<std::uint64_t>();
    sums.rejectedValues_ = reader.get<std::uint64_t>();
    const auto rangeCount = reader.get<std::uint64_t>();
    if (rangeCount > kMaxBatches || sums.layers_ < 1 || sums.layers_ > kMaxLayers ||
        !imageSizeProblem(sums.width_, sums.height_, 3).empty()) {
        reader.fail("its sizes make no sense");
    }
    if (!std::isnormal(sums.quantum_) || !std::isnormal(sums.energyQuantum_))
        reader.fail("its units make no sense");
    if (rangeCount > bytes.size() / sizeof(BatchRange)) reader.fail("it ends too early");
    sums.batches_.resize(rangeCount);
    reader.getAll(sums.batches_);
    requireBatches(sums.batches_, reader);
    sums.energy_ = reader.get<decltype(sums.energy_)>();
    const std::size_t values = static_cast<std::size_t>(sums.width_) *
                               static_cast<std::size_t>(sums.height_) *
                               static_cast<std::size_t>(sums.layers_) * 3;
    if (values > bytes.size() / sizeof(Int128)) reader.fail("it ends too early");
    sums.sums_.resize(values);
    sums.squares_.resize(values);
    reader.getAll(sums.sums_);
    reader.getAll(sums.squares_);
    const auto isPossible = [limit = Int128{1} << kMaxBits](Int128 sum) {
        return sum >= -limit && sum <= limit;
    };
    for (const Int128 sum : sums.energy_) {
        if (!isPossible(sum)) reader.fail("its sums are larger than batches can make them");
    }
    for (std::size_t i = 0; i < values; ++i) {
        if (!isPossible(sums.sums_[i]) || !isPossible(sums.squares_[i]) || sums.squares_[i] < 0)
            reader.fail("its sums are larger than batches can make them");
    }
    if (reader.take(kHashDigits).size() != kHashDigits || !reader.isAtEnd())
        reader.fail("it is too long");
    return sums;
}

}  // namespace kaustik::reference
