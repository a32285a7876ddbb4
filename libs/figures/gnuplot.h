// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace sidestep {

/// Runs a gnuplot script, without the user's own settings. `what` is what it makes, for the error's text.
/// @throws Error (internal) if gnuplot is not installed, or with the last line that it wrote.
void runGnuplot(const std::string& script, const std::string& what);

/// Colours of Okabe and Ito and some more, told apart with any colour vision; as gnuplot writes them.
const char* figureColour(size_t index);

/// `text` as a gnuplot string that means just these characters.
std::string gnuplotQuoted(const std::string& text);

}  // namespace sidestep
