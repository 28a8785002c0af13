// Mutates JSON as text half of the time, and else puts a number in another's place that has hurt programs
// before.
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

constexpr std::string_view numbers[] = {"0",         "-0.0",
                                        "1",         "-1",
                                        "2",         "3",
                                        "24",        "25",
                                        "1000",      "1000000000",
                                        "1e-17",     "1e-300",
                                        "5e-324",    "1e17",
                                        "1e150",     "1e300",
                                        "-1e300",    "1.7976931e308",
                                        "0.5",       "0.3333333333333333",
                                        "1e999",     "NaN",
                                        "-1e-9",     "65536",
                                        "2147483648"};

struct Place {
  std::size_t at, length;
};

std::vector<Place> numbers_in(std::string_view text) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() &&
           (std::isdigit(static_cast<unsigned char>(text[end])) != 0 ||
            (end == i ? text[end] == '-' : std::string_view("+-.eE").find(text[end]) < 5))) {
      ++end;
    }
    if (end > i) places.push_back({i, end - i});
    i = end > i ? end : i + 1;
  }
  return places;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  std::string text(reinterpret_cast<const char*>(data), size);
  const std::vector<Place> places = numbers_in(text);
  if (places.empty() || random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  const Place place = places[random() % places.size()];
  text.replace(place.at, place.length, numbers[random() % std::size(numbers)]);
  if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
  text.copy(reinterpret_cast<char*>(data), text.size());
  return text.size();
}
