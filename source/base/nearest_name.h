// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_nearest_name_h
#define taut_nearest_name_h

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace taut
{
  /// Number of letters to insert, delete or replace to turn one word into the other; case does not
  /// count.
  inline std::size_t edit_distance(const std::string &a, const std::string &b)
  {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
      row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= b.size(); ++j)
      {
        const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                          std::tolower(static_cast<unsigned char>(b[j - 1]));
        const std::size_t above = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (same ? 0 : 1)});
        diagonal = above;
      }
    }
    return row[b.size()];
  }

  /// The known name nearest to a mistyped one; empty if none is near.
  inline std::string nearest_name(const std::string &name, const std::vector<std::string> &known)
  {
    std::string best;
    std::size_t least = std::max<std::size_t>(2, name.size() / 2) + 1;
    for (const std::string &candidate : known)
    {
      const std::size_t distance = edit_distance(name, candidate);
      if (distance < least)
      {
        least = distance;
        best = candidate;
      }
    }
    return best;
  }

  /// End of a message about an unknown name: the nearest known name, or the first known names.
  inline std::string suggestion(const std::string &name, const std::vector<std::string> &known)
  {
    const std::string nearest = nearest_name(name, known);
    if (!nearest.empty())
      return "; did you mean '" + nearest + "'?";
    constexpr std::size_t most = 20;
    std::string all;
    for (std::size_t i = 0; i < std::min(known.size(), most); ++i)
      all += (i == 0 ? "" : ", ") + known[i];
    if (known.size() > most)
      all += " and " + std::to_string(known.size() - most) + " more";
    return all.empty() ? "; there is none here" : "; known here: " + all + ".";
  }
} // namespace taut

#endif
