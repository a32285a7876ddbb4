// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace sidestep {

/// `path` with ${NAME} replaced by the environment's.
/// @param where  for the message
/// @param or_else  what else may be done about it, for the message
/// @throws DatasetError if the environment does not say.
std::string withVariables(const std::string& path, const std::string& where, const std::string& or_else = "");

/// The same, and started at the folder of `study_file` where it is relative.
std::string resolvedPath(const std::string& path, const std::string& study_file);

}  // namespace sidestep
