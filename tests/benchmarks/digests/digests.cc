// SPDX-License-Identifier: LGPL-2.1-or-later
// Prints a hash of all states and multipliers of scenes, one line a run, and of the verdicts on the
// matrix of extreme scenes. digests.py runs it in all forms and compares with the stored lines.
#include "../../extremes/observation.h"
#include "../../extremes/scene_matrix.h"

#include <taut/base/communicator.h>
#include <taut/simulation/simulation.h>

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  /// FNV-1a over the bytes of numbers. A zero counts without its sign.
  class Hash
  {
  public:
    void add(const double value)
    {
      const double number = value == 0. ? 0. : value;
      std::uint64_t bits;
      std::memcpy(&bits, &number, sizeof bits);
      add_bits(bits);
    }
    void add(const std::vector<double> &values)
    {
      for (const double value : values)
        add(value);
    }
    void add(const std::string &text)
    {
      for (const char c : text)
        add_bits(static_cast<unsigned char>(c));
    }
    void add_bits(const std::uint64_t bits)
    {
      for (int byte = 0; byte < 8; ++byte)
        hash = (hash ^ ((bits >> (8 * byte)) & 0xff)) * 0x100000001b3ull;
    }
    std::uint64_t value() const { return hash; }

  private:
    std::uint64_t hash = 0xcbf29ce484222325ull;
  };

  /// Hashes displacements, velocities and accelerations of each body, and what all ranks have.
  class Digest : public taut::Observer
  {
  public:
    void record(const taut::StepView &view) override
    {
      ++n_records;
      of_bodies.resize(view.structure.size());
      for (std::size_t k = 0; k < of_bodies.size(); ++k)
        for (const taut::BodyVectors *v : {&view.state.U, &view.state.V, &view.state.A})
          of_bodies[k].add((*v)[k]);
      of_rows.add(view.state.time);
      of_rows.add(view.state.multiplier);
      of_rows.add(view.state.complementarity_gap);
      structure = &view.structure;
      last = &view.state;
    }

    /// The same on any number of ranks that compute the same bits. Called by all ranks together.
    std::uint64_t value() const
    {
      // Halves of hashes are exact as numbers, and each body has one rank.
      const std::size_t n = structure ? structure->all_bodies().size() : 0;
      std::vector<double> halves(2 * n, 0.);
      for (std::size_t k = 0; k < of_bodies.size(); ++k)
      {
        const std::size_t b = structure->number(k);
        halves[2 * b] = static_cast<double>(of_bodies[k].value() & 0xffffffffull);
        halves[2 * b + 1] = static_cast<double>(of_bodies[k].value() >> 32);
      }
      if (structure)
        structure->communicator().sum(halves);
      Hash all;
      all.add(halves);
      all.add_bits(of_rows.value());
      return all.value();
    }

    /// Displacements, velocities and multipliers of the last record as raw doubles.
    void write_arrays(const std::string &file) const
    {
      std::ofstream out(file, std::ios::binary);
      const auto write = [&](const std::vector<double> &v)
      {
        out.write(reinterpret_cast<const char *>(v.data()),
                  static_cast<std::streamsize>(v.size() * sizeof(double)));
      };
      for (const taut::BodyVectors *vectors : {&last->U, &last->V})
        for (const std::vector<double> &v : *vectors)
          write(v);
      write(last->multiplier);
    }

    long n_records = 0;

  private:
    const taut::Structure *structure = nullptr;
    const taut::State *last = nullptr;
    std::vector<Hash> of_bodies;
    Hash of_rows;
  };

  std::string new_folder()
  {
    static int count = 0;
    return (std::filesystem::temp_directory_path() /
            ("taut_digests_" + std::to_string(getpid()) + "_" + std::to_string(++count)))
        .string();
  }

  void print_scene(const std::string &file, const std::vector<std::string> &overrides,
                   const std::string &arrays, const taut::Communicator &processes)
  {
    const std::string name = std::filesystem::path(file).stem().string();
    std::string folder = new_folder();
    processes.broadcast(folder);
    Digest digest;
    std::string ending = "complete";
    std::ostringstream log;
    try
    {
      taut::Parameters parameters;
      std::vector<std::string> all = {"Output/Folder=" + folder, "Output/Field interval=0",
                                      "Output/Interval=1e9", "Output/Link interval=1e9"};
      all.insert(all.end(), overrides.begin(), overrides.end());
      parameters.read(file, all);
      taut::Simulation simulation(parameters, log, processes);
      simulation.observe(digest);
      try
      {
        simulation.run();
      }
      catch (const std::exception &why)
      {
        ending = std::string("ended: ") + why.what();
        std::replace(ending.begin(), ending.end(), '\n', ' ');
      }
      const std::uint64_t value = digest.value();
      if (processes.is_root())
        std::printf("%s %016llx %ld %s\n", name.c_str(), static_cast<unsigned long long>(value),
                    digest.n_records, ending.c_str());
      if (!arrays.empty() && processes.size() == 1 && digest.n_records > 0)
        digest.write_arrays(arrays + "/" + name);
    }
    catch (const std::exception &why)
    {
      if (processes.is_root())
        std::printf("%s - 0 %s\n", name.c_str(), why.what());
    }
    std::fflush(stdout);
    std::error_code ignored;
    if (processes.is_root())
      std::filesystem::remove_all(folder, ignored);
  }

  /// One line a family and cover: scenes with an answer, and a hash of which these are.
  void print_extremes()
  {
    using Family = std::vector<extremes::Case> (*)(unsigned int);
    const std::pair<const char *, Family> families[] = {{"masses", extremes::masses},
                                                        {"wires", extremes::wires},
                                                        {"sliding", extremes::sliding},
                                                        {"resting", extremes::resting}};
    for (const auto &[name, family] : families)
      for (unsigned int seed = 1; seed <= 7; ++seed)
      {
        Hash verdicts;
        int n = 0, n_answers = 0;
        for (const extremes::Case &c : family(seed))
        {
          const extremes::Answer answer = extremes::program_answer(c);
          ++n;
          n_answers += answer.error.empty();
          verdicts.add(c.name);
          verdicts.add(answer.error.empty() && answer.certificate < 1e-6 ? 1. : 0.);
        }
        std::printf("extremes/%s/%u %016llx %d of %d\n", name, seed,
                    static_cast<unsigned long long>(verdicts.value()), n_answers, n);
        std::fflush(stdout);
      }
  }
} // namespace

/// digests [--set Entry=Value]... [--arrays FOLDER] FILE.prm... | digests --extremes
int main(int argc, char **argv)
{
  std::vector<std::string> overrides, files;
  std::string arrays;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    if (argument == "--set" && i + 1 < argc)
      overrides.push_back(argv[++i]);
    else if (argument == "--arrays" && i + 1 < argc)
      arrays = argv[++i];
    else if (argument == "--extremes")
    {
      print_extremes();
      return 0;
    }
    else
      files.push_back(argument);
  }
  const bool has_ranks = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
  if (has_ranks)
    taut::start_mpi();
  const taut::Communicator processes =
      has_ranks ? taut::Communicator(MPI_COMM_WORLD) : taut::Communicator();
  for (const std::string &file : files)
    print_scene(file, overrides, arrays, processes);
  return 0;
}
