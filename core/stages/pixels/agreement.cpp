// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stages/pixels/agreement.hpp"

#include <algorithm>

namespace mtstereo {

void share_agreement(const WindowVotes& votes, Image<std::uint8_t>& shares) {
  for (int row = 0; row < votes.rows; ++row) {
    const int y0 = std::max(row - kAgreementReach, 0);
    const int y1 = std::min(row + kAgreementReach, votes.rows - 1);
    for (int column = 0; column < votes.columns; ++column) {
      const int x0 = std::max(column - kAgreementReach, 0);
      const int x1 = std::min(column + kAgreementReach, votes.columns - 1);
      int agreeing = 0, compared = 0;
      for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
          const std::ptrdiff_t tile = static_cast<std::ptrdiff_t>(y) * votes.columns + x;
          agreeing += votes.agreeing[tile];
          compared += votes.compared[tile];
        }
      }
      shares.row(row)[column] =
          static_cast<std::uint8_t>(kFullAgreement * agreeing / std::max(compared, 1));
    }
  }
}

}  // namespace mtstereo
