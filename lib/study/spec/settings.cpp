#include "study/spec/settings.h"

#include "core/error.h"

namespace phos::inline study {

std::vector<Setting> expand_settings(const StudyFile& study) {
  constexpr std::size_t kMost = 100000;
  std::vector<std::size_t> counts{study.scenes.size(), study.cameras.size()};
  for (const Factor& f : study.factors) counts.push_back(f.words.size());
  std::size_t total = 1;
  for (const std::size_t n : counts) {
    total *= n;
    if (total > kMost)
      throw Error(
          ExitCode::usage, study.path,
          text("has more than ", kMost, " settings (every value with every other); shorten its lists"));
  }
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < total; ++i) {
    std::vector<std::size_t> digits(counts.size());
    std::size_t rest = i;
    for (std::size_t d = counts.size(); d-- > 0; rest /= counts[d]) digits[d] = rest % counts[d];
    settings.push_back({digits[0], digits[1], {digits.begin() + 2, digits.end()}});
  }
  return settings;
}

std::string describe(const StudyFile& study, const Setting& setting) {
  std::string words;
  for (std::size_t i = 0; i < study.factors.size(); ++i) {
    const Factor& f = study.factors[i];
    bool alone = true;  // the section is named where two have an option of this name
    for (const Factor& other : study.factors) alone = alone && (&other == &f || other.option != f.option);
    if (!words.empty()) words += ", ";
    words.append(alone ? f.option : f.name()).append(" ").append(f.labels[setting.level[i]]);
  }
  return words.empty() ? "as given" : words;
}

}  // namespace phos::inline study
