// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/table_calls.h"

#include "base/text.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <regex>

namespace taut
{
  namespace
  {
    /// What stands in the brackets of 'table(...)'.
    struct Call
    {
      std::string variable;
      std::shared_ptr<const TabulatedFunction> table;
    };

    std::string join(const std::vector<std::string> &words)
    {
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : ", ") + word;
      return text;
    }

    Call make_call(const std::string &arguments, const std::vector<std::string> &variables,
                   const std::string &entry)
    {
      const std::string call = "'table(" + arguments + ")'";
      const std::vector<std::string> words = split(arguments, ',');
      if (words.size() < 2 || words[0].empty() || words[1].empty())
        throw EntryError(entry, call + " does not name a file and a column; write "
                                       "table(FILE.csv, column)");
      Call result;
      if (variables.size() == 1)
        result.variable = variables.front();
      Interpolation kind = Interpolation::linear;
      for (std::size_t i = 2; i < words.size(); ++i)
        if (words[i] == "cubic")
          kind = Interpolation::cubic;
        else if (std::find(variables.begin(), variables.end(), words[i]) != variables.end())
          result.variable = words[i];
        else
          throw EntryError(entry, call + ": '" + words[i] +
                                      "' is no word for a table here; after file and column come " +
                                      join(variables) + " (its abscissa) or cubic");
      if (result.variable.empty())
        throw EntryError(entry, call + " does not say what its first column is: one of " +
                                    join(variables) + ", as in table(" + words[0] + ", " +
                                    words[1] + ", " + variables.back() + ")");
      result.table = shared_table(words[0], words[1], kind, entry);
      return result;
    }

    /// Behind the bracket that closes the one in front of @p begin.
    std::size_t end_of_call(const std::string &text, const std::size_t begin,
                            const std::string &entry)
    {
      int depth = 1;
      for (std::size_t i = begin; i < text.size(); ++i)
        if ((depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0) == 0)
          return i + 1;
      throw EntryError(entry, "the bracket of 'table(' in '" + text + "' is never closed");
    }
  } // namespace

  TableCalls::TableCalls(const std::string &text, const std::vector<std::string> &variables,
                         const std::string &entry)
  {
    static const std::regex opening("\\btable\\s*\\(");
    std::size_t at = 0;
    for (std::smatch match; std::regex_search(text.begin() + at, text.end(), match, opening);)
    {
      const std::size_t found = at + match.position(), begin = found + match.length(),
                        end = end_of_call(text, begin, entry);
      const Call call = make_call(text.substr(begin, end - 1 - begin), variables, entry);
      const bool is_all = trim(text.substr(0, found) + text.substr(end)).empty();
      alone = is_all ? call.variable : "";
      formula += text.substr(at, found - at) + "table_" + std::to_string(tables.size()) + "(" +
                 call.variable + ")";
      tables.push_back(call.table);
      at = end;
    }
    formula += text.substr(at);
  }
} // namespace taut
