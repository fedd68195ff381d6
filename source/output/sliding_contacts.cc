// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/nearest_name.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/output/sliding_contacts.h>

#include <algorithm>

namespace taut
{
  std::vector<SlidingContact> sliding_contacts(const Scene &scene, const Constraints &rows)
  {
    std::vector<SlidingContact> contacts;
    for (const std::size_t i : rows.sliding_rows())
    {
      if (!rows[i].is_link())
        continue;
      const std::size_t link = rows[i].link;
      const std::string strip = link < scene.links.size() ? scene.links[link].strip : "";
      const auto known =
          std::find_if(contacts.begin(), contacts.end(),
                       [&](const SlidingContact &c) { return c.is_strip && c.name == strip; });
      if (!strip.empty() && known != contacts.end())
      {
        known->links.push_back(link);
        known->names.push_back(rows[i].name);
        continue;
      }
      contacts.push_back(
          {strip.empty() ? rows[i].name : strip, {link}, {rows[i].name}, !strip.empty()});
    }
    return contacts;
  }

  namespace
  {
    template <typename... Texts>
    [[noreturn]] void fail(const Texts &...texts)
    {
      throw EntryError("Statistics/Sums", to_text(texts...));
    }

    bool is_same(const ContactSum::Part &a, const ContactSum::Part &b)
    {
      return a.contact == b.contact && a.wire == b.wire;
    }

    /// All wires of a sliding contact with this name, or the wire of a strip with it.
    std::vector<ContactSum::Part> parts_of(const std::string &name,
                                           const std::vector<SlidingContact> &contacts)
    {
      std::vector<ContactSum::Part> parts;
      for (std::size_t c = 0; c < contacts.size(); ++c)
        for (std::size_t w = 0; w < contacts[c].names.size(); ++w)
          if (name == contacts[c].name || name == contacts[c].names[w])
            parts.push_back({c, w});
      return parts;
    }

    std::vector<std::string> known_names(const std::vector<SlidingContact> &contacts)
    {
      std::vector<std::string> known;
      for (const SlidingContact &contact : contacts)
      {
        known.push_back(contact.name);
        if (contact.is_strip)
          known.insert(known.end(), contact.names.begin(), contact.names.end());
      }
      return known;
    }

    ContactSum sum_from(const std::string &text, const std::vector<SlidingContact> &contacts)
    {
      const std::size_t colon = text.find(':');
      ContactSum sum;
      if (colon != std::string::npos)
        sum = {trim(text.substr(0, colon)), split(text.substr(colon + 1) + ' ', '+')};
      if (sum.name.empty() || sum.of.empty() ||
          std::count(sum.of.begin(), sum.of.end(), std::string()) > 0)
        fail("'", text, "' is no sum; write 'NAME: CONTACT + CONTACT'");
      const std::vector<std::string> known = known_names(contacts);
      if (known.empty())
        fail("the scene has no sliding contacts; leave it empty");
      for (const std::string &name : sum.of)
      {
        const std::vector<ContactSum::Part> parts = parts_of(name, contacts);
        if (parts.empty())
          fail("there is no sliding contact '", name, "'", suggestion(name, known));
        for (const ContactSum::Part &part : parts)
          if (std::any_of(sum.parts.begin(), sum.parts.end(),
                          [&](const ContactSum::Part &other) { return is_same(part, other); }))
            fail("'", sum.name, "' has '", contacts[part.contact].names[part.wire],
                 "' twice; name each contact once");
        sum.parts.insert(sum.parts.end(), parts.begin(), parts.end());
      }
      if (std::count(known.begin(), known.end(), sum.name) > 0)
        fail("'", sum.name, "' is the name of a sliding contact; give the sum another");
      return sum;
    }
  } // namespace

  std::vector<ContactSum> contact_sums(const std::vector<std::string> &texts,
                                       const std::vector<SlidingContact> &contacts)
  {
    std::vector<ContactSum> sums;
    for (const std::string &text : texts)
    {
      ContactSum sum = sum_from(text, contacts);
      if (std::any_of(sums.begin(), sums.end(),
                      [&](const ContactSum &other) { return other.name == sum.name; }))
        fail("two sums are called '", sum.name, "'; rename one");
      sums.push_back(std::move(sum));
    }
    return sums;
  }

  ContactRecord sum_of(const std::vector<ContactRecord> &records)
  {
    ContactRecord result = records.at(0);
    for (std::size_t i = 1; i < records.size(); ++i)
      result.add(records[i]);
    return result;
  }
} // namespace taut
