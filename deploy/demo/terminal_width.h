// SPDX-License-Identifier: Apache-2.0
#pragma once
// How many columns a line of text may have.

namespace ehm::demo {

/// Of the terminal behind the descriptor; if it is none, what COLUMNS says, else 80.
int terminal_width(int descriptor);

}  // namespace ehm::demo
