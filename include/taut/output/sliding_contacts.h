// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sliding_contacts_h
#define taut_sliding_contacts_h

#include <taut/interface/constraints.h>
#include <taut/output/contact_quantities.h>
#include <taut/scene/scene.h>

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /// A sliding contact as results name it: a link, or all links of one strip, whose force is the
  /// sum over its wires.
  struct SlidingContact
  {
    std::string name;               ///< of the link or the strip
    std::vector<std::size_t> links; ///< of the scene; the first one gives the position
    std::vector<std::string> names; ///< of the links
    bool is_strip = false;
  };

  /// The sliding contacts in the order of @p rows. Rows of a program without a scene are single
  /// contacts.
  std::vector<SlidingContact> sliding_contacts(const Scene &scene, const Constraints &rows);

  /// A sum of the forces of several sliding contacts at equal times. Its position is that of the
  /// first of them.
  struct ContactSum
  {
    /// A wire of a sliding contact.
    struct Part
    {
      std::size_t contact = 0, wire = 0;
    };

    std::string name;
    std::vector<std::string> of; ///< names of sliding contacts, strips or links of strips
    std::vector<Part> parts = {};
  };

  /**
   * Sums from texts like "both: pantograph 1 + pantograph 2". Throws EntryError for Statistics/Sums
   * if a text has no name or no such contacts, if a sum has a contact twice, or if its name is that
   * of another sum or of a contact.
   */
  std::vector<ContactSum> contact_sums(const std::vector<std::string> &texts,
                                       const std::vector<SlidingContact> &contacts);

  /// Sum of the forces of records with equal times, with the places of the first one.
  ContactRecord sum_of(const std::vector<ContactRecord> &records);
} // namespace taut

#endif
