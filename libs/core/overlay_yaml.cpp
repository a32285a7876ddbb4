// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/overlay_yaml.h"

#include <sstream>

namespace sidestep {

std::string plainYaml(const Visit& fields) {
  std::string out;
  std::istringstream all(writeYaml(fields));
  for (std::string line; std::getline(all, line);) {
    if (const auto note = line.find("  # "); note != std::string::npos) line.resize(note);
    const auto first = line.find_first_not_of(' ');
    if (first != std::string::npos && line[first] != '#') out += line + "\n";
  }
  return out;
}

bool isBlank(const std::string& yaml) { return yaml.find_first_not_of(" \n") == std::string::npos; }

}  // namespace sidestep
