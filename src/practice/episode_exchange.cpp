#include "practice/episode_exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <type_traits>

namespace lstm_planner {
namespace {

/// Calls field(member) for all that a drive consists of.
template <typename Episode, typename Field>
void forEachField(Episode* episode, const Field& field) {
  field(&episode->kind);
  field(&episode->arrived);
  field(&episode->is_example);
  field(&episode->steps);
  field(&episode->inputs);
  field(&episode->bearings);
  field(&episode->probabilities);
}

class Writer {
 public:
  template <typename Value>
  void operator()(const Value* value) const {
    static_assert(std::is_trivially_copyable_v<Value>, "values are sent as bytes");
    append(value, sizeof(Value));
  }
  template <typename Value>
  void operator()(const std::vector<Value>* values) const {
    static_assert(std::is_trivially_copyable_v<Value>, "values are sent as bytes");
    const std::size_t count = values->size();
    append(&count, sizeof(count));
    append(values->data(), count * sizeof(Value));
  }

  explicit Writer(std::vector<std::uint8_t>* bytes) : bytes_(*bytes) {}

 private:
  void append(const void* from, std::size_t size) const {
    const auto* const first = static_cast<const std::uint8_t*>(from);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<std::uint8_t>& bytes_;
};

class Reader {
 public:
  explicit Reader(const std::uint8_t** next) : next_(*next) {}

  template <typename Value>
  void operator()(Value* value) const {
    take(value, sizeof(Value));
  }
  template <typename Value>
  void operator()(std::vector<Value>* values) const {
    std::size_t count = 0;
    take(&count, sizeof(count));
    values->resize(count);
    take(values->data(), count * sizeof(Value));
  }

 private:
  void take(void* to, std::size_t size) const {
    if (size > 0) std::memcpy(to, next_, size);
    next_ += size;
  }

  const std::uint8_t*& next_;
};

}  // namespace

std::vector<PracticeEpisode> exchangeEpisodes(Communicator* ranks, std::vector<PracticeEpisode> own) {
  if (ranks->size() == 1) return own;
  std::vector<std::uint8_t> written;
  for (const PracticeEpisode& episode : own) forEachField(&episode, Writer(&written));

  std::vector<std::size_t> bytes(static_cast<std::size_t>(ranks->size()));
  bytes[static_cast<std::size_t>(ranks->rank())] = written.size();
  exchangeShares(ranks, ranks->size(), 1, bytes.data());
  std::vector<std::uint8_t> all(std::accumulate(bytes.begin(), bytes.end(), std::size_t{0}));
  const std::size_t before = std::accumulate(bytes.begin(), bytes.begin() + ranks->rank(), std::size_t{0});
  std::copy(written.begin(), written.end(), all.begin() + static_cast<std::ptrdiff_t>(before));
  ranks->exchangeBytes(all.data(), bytes);

  std::vector<PracticeEpisode> episodes;
  for (const std::uint8_t* next = all.data(); next != all.data() + all.size();) {
    forEachField(&episodes.emplace_back(), Reader(&next));
  }
  return episodes;
}

}  // namespace lstm_planner
