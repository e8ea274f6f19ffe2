// Golden tables of the estimators (data/golden/irradiance).
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace phos::test {

/// Rows of a table of data/golden/irradiance, by column name.
inline std::vector<std::map<std::string, std::string>> golden(const std::string& name) {
  std::ifstream in(std::string(PHOS_SOURCE) + "/data/golden/irradiance/" + name);
  std::vector<std::string> header;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.pop_back();
    std::vector<std::string> cells;
    std::istringstream fields(line);
    for (std::string cell; std::getline(fields, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = i < cells.size() ? cells[i] : "";
  }
  return rows;
}

}  // namespace phos::test
