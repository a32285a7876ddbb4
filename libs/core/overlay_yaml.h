// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "core/params.h"

namespace sidestep {

/// All fields as YAML without comments, to stand in an overlay.
std::string plainYaml(const Visit& fields);

/// Whether an overlay says nothing.
bool isBlank(const std::string& yaml);

}  // namespace sidestep
