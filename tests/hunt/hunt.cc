// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a run of 'Scheme = automatic' is within 2 % of its reference in places and impulses and
// within 5 % in energies, or a warning says which step it needs, or the run is refused. Source:
// motions between events by the exponential of the matrices, impacts by Newton's law; the equation
// of a pendulum; another scheme with a sixteenth of the step under contacts that move.
#include "common.h"
#include "verdict.h"

#include <chrono>
#include <cmath>

namespace
{
  using hunt::Verdict;
  using verification::has;

  /// Parts of the decidable scenes that agree, and that do so in vain; part that is not decided.
  constexpr double least_agreed = .6, most_alarms = .05, most_undecided = .1;

  /// Fewer scenes than this show a rate within two standard deviations of their number only.
  constexpr double least_for_a_rate = 1000.;

  constexpr unsigned long default_scenes = 100, default_seed = 1;

  unsigned long from_environment(const char *name, const unsigned long otherwise)
  {
    const char *value = std::getenv(name);
    return value ? std::strtoul(value, nullptr, 10) : otherwise;
  }

  using Counts = std::array<unsigned long, hunt::n_verdicts>;

  void print_line(const std::string &name, const Counts &counts)
  {
    std::printf("%-22s", name.c_str());
    for (const unsigned long n : counts)
      std::printf("%14lu", n);
    std::printf("\n");
  }

  void print_table(const hunt::Field field, const std::map<std::string, Counts> &table,
                   const Counts &total)
  {
    std::printf("%-22s", "family");
    for (std::size_t i = 0; i < hunt::n_verdicts; ++i)
      std::printf("%14s", hunt::name(static_cast<Verdict>(i)));
    std::printf("\n");
    for (const std::string &family : hunt::families(field))
      if (const auto found = table.find(family); found != table.end())
        print_line(family, found->second);
    print_line("all", total);
  }

  void write_scene(std::ofstream &file, const unsigned long seed, const unsigned long number,
                   const hunt::HuntScene &scene, const hunt::Finding &finding)
  {
    file << "# seed " << seed << ", scene " << number << ", " << scene.family << ": "
         << hunt::name(finding.verdict) << "\n# differences: places " << finding.difference.place
         << (finding.compares_places ? "" : " (chaotic, not compared)") << ", impulses "
         << finding.difference.impulse << ", energies " << finding.difference.energy << '\n';
    std::istringstream said(finding.what + "\n" + finding.log);
    for (std::string line; std::getline(said, line);)
      if (has(line, "Scheme (") || has(line, "Warning") || has(finding.what, line))
        file << "# " << line << '\n';
    file << scene.text << "\n\n";
  }
} // namespace

// A second method for the references: the program itself, with steps that resolve more and more.
TEST(References, fine_steps_come_to_them)
{
  constexpr unsigned long seed = 3, n = 300, least_compared = 50;
  constexpr double most_steps = 80.;
  unsigned long compared = 0;
  for (unsigned long i = 0; i < n; ++i)
  {
    const hunt::HuntScene scene = hunt::make_scene(seed, i);
    if (scene.n_steps > most_steps)
      continue;
    hunt::Finding finding;
    bool agrees = false;
    for (const double parts : {64., 512., 4096.})
    {
      finding = hunt::judge(scene, parts);
      agrees = finding.verdict == Verdict::agreed || finding.verdict == Verdict::agreed_but_warned;
      if (agrees || finding.verdict == Verdict::not_decidable)
        break;
    }
    if (finding.verdict == Verdict::not_decidable)
      continue;
    ++compared;
    EXPECT_TRUE(agrees) << scene.family << ", scene " << i << ": places "
                        << finding.difference.place << ", impulses " << finding.difference.impulse
                        << ", energies " << finding.difference.energy << ' ' << finding.what;
  }
  EXPECT_GE(compared, least_compared);
}

// Damped stops whose contacts are shorter than a step, ropes that do not rebound, stiff joints that
// a step does not resolve, impacts that longer steps miss by the same amount or at another time:
// impulses are off there while places and energies are not.
TEST(Bounds, impulses_that_are_off_are_named)
{
  using hunt::Field;
  struct Wrong
  {
    unsigned long seed, number;
    Field field = Field::contacts;
  };
  for (const auto &[seed, number, field] : {Wrong{2, 360},
                                            {11, 243},
                                            {11, 423},
                                            {11, 1079},
                                            {12, 1763},
                                            {13, 683},
                                            {14, 875},
                                            {14, 1635},
                                            {15, 1584},
                                            {18, 495},
                                            {107, 496},
                                            {109, 1627},
                                            {111, 1891, Field::given},
                                            {115, 955, Field::given},
                                            {121, 1476, Field::given}})
  {
    const hunt::Finding finding = hunt::judge(hunt::make_scene(seed, number, field));
    EXPECT_EQ(hunt::name(finding.verdict), hunt::name(Verdict::warned_and_wrong))
        << "seed " << seed << ", scene " << number;
    EXPECT_GT(finding.difference.impulse, hunt::impulse_bound);
    EXPECT_LT(finding.difference.place, hunt::place_bound);
    EXPECT_LT(finding.difference.energy, hunt::energy_bound);
  }
}

// Contacts of a strip whose energy would allow impulses to be off by more than the bound: shorter
// steps resolve them, and give the same impulses.
TEST(Bounds, impulses_that_shorter_steps_confirm_are_not_warned_of)
{
  for (const unsigned long number : {101ul, 1029ul})
  {
    const hunt::Finding finding = hunt::judge(hunt::make_scene(119, number, hunt::Field::compound));
    EXPECT_EQ(hunt::name(finding.verdict), hunt::name(Verdict::agreed)) << "scene " << number;
  }
}

namespace
{
  void hunt_in(const hunt::Field field, const std::string &of_field)
  {
    const unsigned long n = from_environment("TAUT_HUNT_SCENES", default_scenes),
                        seed = from_environment("TAUT_HUNT_SEED", default_seed),
                        first = from_environment("TAUT_HUNT_FIRST", 0),
                        parts = from_environment("TAUT_HUNT_PARTS", 1);
    const std::string path = "hunt_" + of_field + "seed_" + std::to_string(seed) + ".txt";
    std::ofstream file(path);
    std::map<std::string, Counts> table;
    Counts total = {};
    for (unsigned long i = first; i < first + n; ++i)
    {
      const hunt::HuntScene scene = hunt::make_scene(seed, i, field);
      const auto begin = std::chrono::steady_clock::now();
      const hunt::Finding finding = hunt::judge(scene, parts);
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      const auto index = static_cast<std::size_t>(finding.verdict);
      ++table[scene.family][index];
      ++total[index];
      if (finding.verdict != Verdict::agreed)
        write_scene(file, seed, i, scene, finding);
      if (std::getenv("TAUT_HUNT_VERBOSE"))
        std::printf("%5lu %-22s %-14s %9.2e %9.2e %9.2e %5.2f s %s\n", i, scene.family.c_str(),
                    hunt::name(finding.verdict), finding.difference.place,
                    finding.difference.impulse, finding.difference.energy, seconds,
                    finding.what.substr(0, finding.what.find('\n')).c_str());
    }
    print_table(field, table, total);
    std::printf("Scenes that did not just agree: %s\n", path.c_str());
    const auto count = [&](const Verdict verdict) -> double
    { return total[static_cast<std::size_t>(verdict)]; };
    const double undecided = count(Verdict::not_decidable), agreed = count(Verdict::agreed),
                 alarms = count(Verdict::agreed_but_warned) + count(Verdict::agreed_but_refused);
    EXPECT_EQ(count(Verdict::silent_and_wrong), 0.) << "see " << path;
    EXPECT_EQ(count(Verdict::crashed), 0.) << "see " << path;
    EXPECT_GE(agreed + alarms, least_agreed * (n - undecided));
    const double most = most_alarms * (agreed + alarms),
                 by_chance = agreed + alarms < least_for_a_rate ? 2. * std::sqrt(most) : 0.;
    EXPECT_LE(alarms, std::ceil(most + by_chance));
    EXPECT_LE(undecided, most_undecided * n);
  }
} // namespace

TEST(Hunt, no_answer_is_silent_and_wrong)
{
  hunt_in(hunt::Field::contacts, "");
}

TEST(Hunt, given_motions_and_rotations)
{
  hunt_in(hunt::Field::given, "given_");
}

TEST(Hunt, laws_with_dampers_and_strips)
{
  hunt_in(hunt::Field::compound, "compound_");
}
