// SPDX-License-Identifier: LGPL-2.1-or-later
// What the programs of extremes do with an answer: compare it with a copy and a twin, and count.
#ifndef taut_extremes_tally_h
#define taut_extremes_tally_h

#include "scene_numbers.h"

namespace extremes
{
  class Tally
  {
  public:
    /// What is allowed of an entry's own largest value, and of the scale of its quantity; and the
    /// part of scenes that may end in an error (doc/extremes.md has the figure).
    static constexpr double relative = 1e-6, absolute = 1e-7, largest_part_of_errors = .05;

    /// An answer of the program is that of the copy, @p exact, and that of a twin in other units;
    /// where it has none, there is a reason. @p neighbours of the copy have other last digits.
    template <typename MakeTwin>
    void judge(const std::string &family, const std::string &name, const Answer &ours,
               const Answer &exact, const std::array<double, n_quantities> &scale,
               const std::vector<Answer> &neighbours, const Units &other, const MakeTwin &make_twin)
    {
      Summary &s = summaries[family];
      ++s.n_scenes;
      if (!ours.error.empty())
      {
        errors[reason(ours.error)].push_back(name);
        if (exact.error.empty())
          std::printf("no answer | %s | %s\n", name.c_str(), ours.error.c_str());
        return;
      }
      ++s.n_answers;
      s.certificate = std::max(s.certificate, ours.certificate);
      s.iterations = std::max(s.iterations, ours.iterations);
      s.n_fallbacks += ours.n_fallbacks;
      if (!exact.error.empty())
      {
        ++s.n_wrong;
        ADD_FAILURE() << "an answer to a scene that has none: " << exact.error;
        return;
      }
      std::vector<std::vector<Observation>> near;
      for (const Answer &neighbour : neighbours)
        if (neighbour.error.empty())
          near.push_back(neighbour.steps);
      const Deviation d = compare(ours.steps, exact.steps, scale, near, relative, absolute);
      EXPECT_LE(d.excess, 1.) << d.where << "; certificate " << ours.certificate;
      Answer twin = make_twin();
      to_units_of_origin(twin.steps, other);
      if (!twin.error.empty())
      {
        --s.n_answers;
        s.n_wrong += d.excess > 1.;
        errors["in other units: " + reason(twin.error)].push_back(name);
        return;
      }
      const Deviation t = compare(twin.steps, ours.steps, scale, near, relative, absolute);
      EXPECT_LE(t.excess, 1.) << "in other units: " << t.where;
      s.n_wrong += d.excess > 1. || t.excess > 1.;
      if (d.excess <= 1. && t.excess <= 1.)
      {
        s.deviation = std::max(s.deviation, d.excess);
        s.twin = std::max(s.twin, t.excess);
      }
    }

    void print() const
    {
      unsigned int n_scenes = 0, n_answers = 0;
      std::printf("family | scenes | answers | wrong | deviation | of twin | certificate | "
                  "iterations | fallbacks\n");
      for (const auto &[family, s] : summaries)
      {
        std::printf("%s | %u | %u | %u | %.1e | %.1e | %.1e | %u | %u\n", family.c_str(),
                    s.n_scenes, s.n_answers, s.n_wrong, s.deviation, s.twin, s.certificate,
                    s.iterations, s.n_fallbacks);
        n_scenes += s.n_scenes;
        n_answers += s.n_answers;
      }
      for (const auto &[text, scenes] : errors)
      {
        std::printf("error | %zu | %s\n", scenes.size(), text.c_str());
        for (const std::string &scene : scenes)
          std::printf("  %s\n", scene.c_str());
      }
      EXPECT_LE(n_scenes - n_answers, largest_part_of_errors * n_scenes);
    }

  private:
    static std::string reason(const std::string &message)
    {
      if (message.find("singular to working precision") != std::string::npos)
        return "is lost in the rounding";
      for (const char *known :
           {"contradict", "not held", "nothing holds", "nothing that moves",
            "is lost in the rounding", "misses the contact tolerance", "is not solved", "beyond"})
        if (message.find(known) != std::string::npos)
          return known;
      return message;
    }

    struct Summary
    {
      unsigned int n_scenes = 0, n_answers = 0, n_wrong = 0, n_fallbacks = 0, iterations = 0;
      double deviation = 0., twin = 0., certificate = 0.; ///< deviations over what is allowed
    };
    std::map<std::string, Summary> summaries;
    std::map<std::string, std::vector<std::string>> errors; ///< scenes by reason
  };

  /// Covers of a matrix by their seeds: TAUT_EXTREMES_SEEDS=first:last, without it 1 to @p last.
  template <typename Visit>
  void for_each_seed(unsigned int last, const Visit &visit)
  {
    unsigned int first = 1;
    const char *const seeds = std::getenv("TAUT_EXTREMES_SEEDS");
    ASSERT_TRUE(!seeds || std::sscanf(seeds, "%u:%u", &first, &last) == 2) << seeds;
    for (unsigned int seed = first; seed <= last; ++seed)
      visit(seed);
  }

  /// TAUT_EXTREMES_ONLY=text: of the scenes those whose names have the text.
  inline bool is_chosen(const std::string &name)
  {
    const char *const only = std::getenv("TAUT_EXTREMES_ONLY");
    return !only || name.find(only) != std::string::npos;
  }
} // namespace extremes

#endif
