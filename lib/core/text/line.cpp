#include "core/text/line.h"

namespace phos {

std::string one_line(std::string s) {
  for (char& c : s)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  s.erase(s.find_last_not_of(' ') + 1);
  return s;
}

}  // namespace phos
