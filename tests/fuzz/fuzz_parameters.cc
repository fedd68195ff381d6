// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: whatever a parameter file says, it is run with finite numbers and certificates within the
// tolerance, or refused with a UserError of one line. Source: scenes of prm/, changed at random.
#include <taut/simulation/simulation.h>

#include <deal.II/base/utilities.h>

#include <boost/program_options.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <new>
#include <random>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
  namespace fs = std::filesystem;
  using dealii::Utilities::trim;
  using Lines = std::vector<std::string>;

  constexpr double n_steps = 5.;

  bool is_entry(const std::string &line)
  {
    return line.compare(0, 4, "set ") == 0 && line.find('=') != std::string::npos;
  }
  std::string key(const std::string &line)
  {
    return trim(line.substr(4, line.find('=') - 4));
  }
  std::string value(const std::string &line)
  {
    return trim(line.substr(line.find('=') + 1));
  }
  std::string entry(const std::string &name, const std::string &text)
  {
    return "set " + name + " = " + text;
  }

  Lines split(const std::string &text, const char separator)
  {
    Lines parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);)
      parts.push_back(trim(part));
    return parts;
  }

  Lines lines_of(std::istream &in)
  {
    Lines lines;
    for (std::string line; std::getline(in, line);)
    {
      line = trim(line.substr(0, line.find('#')));
      if (!line.empty())
        lines.push_back(line);
    }
    return lines;
  }

  /// A scene of the project that runs within milliseconds.
  Lines coarse(Lines lines)
  {
    double step = 1e-3;
    for (const std::string &line : lines)
      if (is_entry(line) && key(line) == "Step")
        step = std::stod(value(line));
    for (std::string &line : lines)
      if (is_entry(line))
      {
        const std::string name = key(line);
        if (name == "End")
          line = entry(name, std::to_string(n_steps * step));
        else if (name == "Element size")
          line = entry(name, std::to_string(8. * std::stod(value(line))));
        else if (name == "Refinements" || name == "Local refinements")
          line = entry(name, value(line) == "0" ? "0" : "1");
        else if (name == "Number of spans")
          line = entry(name, "3");
        else if (name == "Uplift positions" || name == "Window")
          line = entry(name, "");
        else if (name == "Start" && value(line) == "160")
          line = entry(name, "110");
      }
    return lines;
  }

  /// Section of each line, by its own title.
  std::vector<std::string> sections_of(const Lines &lines)
  {
    std::vector<std::string> open = {""}, result;
    for (const std::string &line : lines)
    {
      if (line.compare(0, 11, "subsection ") == 0)
        open.push_back(trim(line.substr(11)));
      result.push_back(open.back());
      if (line == "end" && open.size() > 1)
        open.pop_back();
    }
    return result;
  }

  class Mutator
  {
  public:
    explicit Mutator(const std::string &folder)
    {
      std::vector<fs::path> files;
      for (const auto &file : fs::directory_iterator(folder))
        if (file.path().extension() == ".prm")
          files.push_back(file.path());
      std::sort(files.begin(), files.end());
      for (const fs::path &path : files)
      {
        std::ifstream in(path);
        corpus.push_back(coarse(lines_of(in)));
        // The listing of a scene names every entry that its sections can have.
        taut::Parameters parameters;
        parameters.read(path.string());
        std::stringstream listing;
        parameters.print(listing);
        const Lines all = lines_of(listing);
        const std::vector<std::string> titles = sections_of(all);
        for (std::size_t i = 0; i < all.size(); ++i)
          if (is_entry(all[i]))
            dictionary[titles[i]].push_back(all[i]);
      }
      if (corpus.empty())
        throw std::runtime_error("no .prm files in " + folder);
    }

    std::string make(const std::uint64_t seed)
    {
      random.seed(seed);
      Lines lines = corpus[below(corpus.size())];
      const std::size_t n = 1 + below(4);
      for (std::size_t k = 0; k < n && !lines.empty(); ++k)
        mutate(lines);
      std::string text;
      for (const std::string &line : lines)
        text += line + "\n";
      if (below(25) == 0)
        for (std::size_t k = 1 + below(4); k > 0 && !text.empty(); --k)
          text[below(text.size())] = static_cast<char>(below(256));
      if (below(100) == 0)
        text.resize(below(text.size() + 1));
      return text;
    }

  private:
    std::size_t below(const std::size_t n) { return random() % n; }

    const std::string &pick(const Lines &list) { return list[below(list.size())]; }

    std::size_t some_entry(const Lines &lines)
    {
      std::size_t i = below(lines.size());
      for (std::size_t k = 0; k < lines.size() && !is_entry(lines[i]); ++k)
        i = (i + 1) % lines.size();
      return i;
    }

    std::string number()
    {
      static const Lines extreme = {"0",      "-0",     "-1",    "1",     "1e300", "-1e300",
                                    "1e-300", "1e308",  "nan",   "inf",   "-inf",  "1e999",
                                    "1e-9",   "1e9",    "1e20",  "-1e20", "0x10",  "4.9e-324",
                                    "1e154",  "1e-154", "1e100", "3",     "2",     "0.5"};
      if (below(3) > 0)
        return pick(extreme);
      std::ostringstream out;
      out << std::ldexp(static_cast<double>(below(2001)) - 1000., static_cast<int>(below(41)) - 30);
      return out.str();
    }

    /// One number of a text changed: by a factor, or to anything.
    std::string scaled(const std::string &text)
    {
      static const std::regex pattern("[-+]?[0-9.]+([eE][-+]?[0-9]+)?");
      std::vector<std::pair<std::size_t, std::size_t>> found;
      for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m)
        found.emplace_back(m->position(), m->length());
      if (found.empty())
        return text;
      const auto at = found[below(found.size())];
      std::string fresh = number();
      if (below(4) > 0)
      {
        static const double factors[] = {-1.,  .1,  .5,   .9,   1.1,   2.,   10.,   1e3,
                                         1e-3, 1e6, 1e-6, 1e12, 1e-12, 1e50, 1e-50, 0.};
        const double before = std::strtod(text.c_str() + at.first, nullptr);
        std::ostringstream out;
        out << factors[below(16)] * (before == 0. ? 1. : before);
        fresh = out.str();
      }
      return text.substr(0, at.first) + fresh + text.substr(at.first + at.second);
    }

    std::string word(const Lines &lines)
    {
      static const Lines words = split(
          "joint|stop|dropper|sliding contact|string|beam|bar|bar, beam|bar, string|"
          "transverse|axial|slope|fixed|elastic|point|distributed|moving|true|false|rigid|"
          "ground|equilibrium|undeformed|given|BDF2|Newmark|backward Euler|generalised-alpha|"
          "automatic|x|y|rotation|x, y|x, y, rotation|sparse direct|block tridiagonal|"
          "matrix-free|assembled dense|assembled sparse|energy-ordered|MPRGP|semismooth Newton|"
          "network|catenary| ",
          '|');
      static const Lines formulas =
          split("1/t|sqrt(0.002-t)|sin(|if(t<0.002,0,100)|s|1e300*t|exp(1e5*t)|abs(s-1)|sin(pi*s)|"
                "1;2|pi|t|0*t|1/(s-1)|sqrt(-s)|10|-1e300|((((((((s))))))))",
                '|');
      if (below(3) == 0)
        return pick(formulas);
      if (below(3) > 0)
        return pick(words);
      // A name, or a value of the file.
      const std::string text = value(lines[some_entry(lines)] + "=");
      const Lines names = split(text, ',');
      return names.empty() ? "" : pick(names) + (below(2) == 0 ? " @ " + number() : "");
    }

    /// An entry that the section of line i can have, in the place of its own if it is there.
    void take_from_dictionary(Lines &lines, const std::size_t i)
    {
      const std::vector<std::string> titles = sections_of(lines);
      const auto known = dictionary.find(titles[i]);
      if (known == dictionary.end())
        return;
      const std::string line = pick(known->second);
      const std::size_t use = below(6);
      const std::string fresh = entry(key(line), use == 0   ? value(line)
                                                 : use == 1 ? number()
                                                 : use == 2 ? word(lines)
                                                            : scaled(value(line)));
      for (std::size_t k = 0; k < lines.size(); ++k)
        if (is_entry(lines[k]) && titles[k] == titles[i] && key(lines[k]) == key(line))
        {
          lines[k] = fresh;
          return;
        }
      lines.insert(lines.begin() + i, fresh);
    }

    std::string list_with(const std::string &text)
    {
      std::string list;
      for (std::size_t k = below(below(10) == 0 ? 300 : 4); k > 0; --k)
        list += (below(2) == 0 ? text : number()) + (k > 1 ? "," : "");
      return list;
    }

    /// A part of a value doubled, lost or misspelt.
    std::string misspelt(std::string text)
    {
      const std::size_t at = below(std::max<std::size_t>(1, text.size()));
      return below(2) == 0 ? text.erase(at, 1 + below(3))
                           : text.insert(at, std::string(1, ",:@ -.e/\"#\\"[below(11)]));
    }

    void mutate(Lines &lines)
    {
      const std::size_t i = some_entry(lines), kind = below(30);
      if (kind == 1)
        lines.erase(lines.begin() + below(lines.size()));
      else if (kind == 2)
        lines.insert(lines.begin() + below(lines.size()), std::string(pick(lines)));
      else if (kind >= 9 && kind <= 12)
        take_from_dictionary(lines, i);
      else if (kind == 15 && below(4) == 0) // the end of another file
      {
        const Lines &other = corpus[below(corpus.size())];
        lines.resize(below(lines.size()) + 1);
        lines.insert(lines.end(), other.begin() + below(other.size()), other.end());
      }
      else if (is_entry(lines[i]))
      {
        const std::string name = key(lines[i]), text = value(lines[i]);
        if (kind == 0) // two values change places
        {
          std::string &other = lines[some_entry(lines)];
          lines[i] = entry(name, value(other));
          other = entry(key(other), text);
        }
        else
          lines[i] = entry(name, kind == 3                ? number()
                                 : kind == 7 || kind == 8 ? word(lines)
                                 : kind == 13             ? list_with(text)
                                 : kind == 14             ? misspelt(text)
                                 : kind == 15             ? ""
                                                          : scaled(text));
      }
    }

    std::vector<Lines> corpus;
    std::map<std::string, Lines> dictionary; ///< entries by the title of their section
    std::mt19937_64 random;
  };

  /// Every number of a run is finite and every step certified.
  class Watch : public taut::Observer
  {
  public:
    explicit Watch(const double tolerance) : tolerance(tolerance) {}

    void record(const taut::StepView &step) override
    {
      const taut::State &state = step.state;
      for (const taut::BodyVectors *vectors :
           {&state.U, &state.V, &state.A, &step.reference.displacement})
        for (const std::vector<double> &vector : *vectors)
          check(vector, "the motion of a body");
      check(state.multiplier, "a multiplier");
      check(state.distance, "a gap");
      check(step.probes, "a probe");
      if (!(step.residuals.max() <= tolerance))
        throw std::logic_error("the certificate of an accepted step misses the tolerance");
    }

  private:
    static void check(const std::vector<double> &values, const char *what)
    {
      for (const double v : values)
        if (!std::isfinite(v))
          throw std::logic_error(std::string(what) + " is not finite");
    }
    double tolerance;
  };

  struct Counts
  {
    std::size_t parsing = 0, validation = 0, start = 0, stepping = 0, ran = 0, large = 0,
                memory = 0;
  };

  const char *volatile where_it_is = ""; ///< for the handlers of signals

  void report_signal(const int signal)
  {
    const char *what = signal == SIGALRM ? "HANG in " : "CRASH in ";
    if (write(STDERR_FILENO, what, std::strlen(what)) < 0 ||
        write(STDERR_FILENO, where_it_is, std::strlen(where_it_is)) < 0 ||
        write(STDERR_FILENO, "\n", 1) < 0)
      _exit(3);
    _exit(2);
  }

  /// No table or summary says nan or inf.
  void check_files(const std::string &folder)
  {
    // Names stand first in a line of a table, or between quotes: one of them may be "inf".
    static const std::regex bad("[, :]-?(nan|inf|null)([, ]|$)");
    for (const auto &file : fs::directory_iterator(folder))
    {
      const std::string extension = file.path().extension().string();
      if (extension != ".csv" && extension != ".json")
        continue;
      std::ifstream in(file.path());
      bool head = extension == ".csv";
      for (std::string line; std::getline(in, line); head = false)
        if (!head &&
            (line.find("nan") != std::string::npos || line.find("inf") != std::string::npos ||
             line.find("null") != std::string::npos) &&
            std::regex_search(line, bad))
          throw std::logic_error(file.path().filename().string() + " says: " + line);
    }
  }

  /// Whether a file refines a mesh far: bodies of plugins do not say their size before they are
  /// made.
  bool refines_far(const std::string &file)
  {
    constexpr double most = 4.;
    std::ifstream in(file);
    const Lines lines = lines_of(in);
    return std::any_of(lines.begin(), lines.end(),
                       [](const std::string &line)
                       {
                         return is_entry(line) && key(line) == "Refinements" &&
                                std::strtod(value(line).c_str(), nullptr) > most;
                       });
  }

  /// Runs one file; throws anything but UserError and lack of memory at a mistake of the program.
  void run_one(const std::string &file, const std::string &results, Counts &counts)
  {
    taut::Parameters parameters;
    std::size_t *stage = &counts.parsing;
    std::ostringstream log;
    std::string message;
    try
    {
      parameters.read(file);
      stage = &counts.validation;
      parameters.output.folder = results;
      parameters.output.overwrite = true;
      parameters.end_time = std::min(parameters.end_time, n_steps * parameters.step);
      const taut::Scene scene = parameters.scene();
      double elements = 0.;
      for (const taut::Wire &wire : scene.wires)
        elements += std::ceil(wire.length() / wire.element_size);
      for (const taut::Support &support : scene.supports)
        elements += support.positions.size();
      for (const taut::PointMass &mass : scene.point_masses)
        elements += mass.positions.size();
      double dofs = 0.; // of cables and solids, whose surfaces may touch with every node
      for (const taut::CustomBody &body : scene.bodies)
        dofs += body.type->n_dofs();
      if (elements > 5000. || dofs > 5000. || scene.links.size() > 150 ||
          scene.masses.size() > 100 || scene.loads.size() > 1000 || refines_far(file))
      {
        ++counts.large;
        return;
      }
      taut::Simulation simulation(parameters, log);
      Watch watch(parameters.solver.contact_tolerance);
      simulation.observe(watch);
      stage = &counts.start;
      fs::remove_all(results);
      try
      {
        simulation.run();
      }
      catch (const taut::UserError &)
      {
        if (fs::exists(results))
          stage = &counts.stepping;
        throw;
      }
      check_files(results);
      ++counts.ran;
      return;
    }
    catch (const taut::EntryError &e)
    {
      message = parameters.explain(e);
    }
    catch (const taut::UserError &e)
    {
      message = e.what();
    }
    catch (const std::exception &e)
    {
      if (!dynamic_cast<const std::bad_alloc *>(&e) && !dynamic_cast<const std::length_error *>(&e))
        throw;
      ++counts.memory;
      return;
    }
    ++*stage;
    if (message.empty() || message.find('\n') != std::string::npos)
      throw std::logic_error("the message is not one line: " + message);
    if (std::getenv("TAUT_PRINT_MESSAGES"))
      std::cout << message << '\n';
  }
} // namespace

int main(int argc, char **argv)
{
  namespace po = boost::program_options;
  std::size_t count = 1000, first = 0, memory = 4000;
  std::uint64_t seed = 1;
  unsigned int seconds = 20;
  std::string corpus, replay, keep = ".";
  po::options_description options("Options");
  options.add_options()("corpus", po::value(&corpus)->required(), "folder of parameter files")(
      "count", po::value(&count), "number of inputs")("first", po::value(&first),
                                                      "number of the first one")(
      "seed", po::value(&seed), "of the random numbers")("seconds", po::value(&seconds),
                                                         "limit of one input [s]")(
      "memory", po::value(&memory), "limit of the process, 0: none [MB]")(
      "keep", po::value(&keep), "folder for inputs that fail")(
      "replay", po::value(&replay), "run this file instead")("help", "print this text");
  po::variables_map arguments;
  try
  {
    po::store(po::parse_command_line(argc, argv, options), arguments);
    if (arguments.count("help"))
    {
      std::cout << options;
      return 0;
    }
    po::notify(arguments);
  }
  catch (const po::error &e)
  {
    std::cerr << e.what() << '\n';
    return 1;
  }

  const fs::path scratch = fs::temp_directory_path() / ("taut_fuzz_" + std::to_string(getpid()));
  fs::create_directories(scratch);
  const std::string results = (scratch / "results").string();
  if (memory > 0)
  {
    const rlimit limit = {memory << 20, memory << 20};
    setrlimit(RLIMIT_AS, &limit);
  }
  for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS})
    std::signal(signal, report_signal);

  std::size_t failures = 0;
  Counts counts;
  std::cout << "seed " << seed << ", inputs " << first << " to " << first + count - 1 << std::endl;
  Mutator mutator(corpus);
  for (std::size_t k = first; k < first + count; ++k)
  {
    std::string file = replay;
    if (replay.empty())
    {
      const std::string text = mutator.make(seed * 1000000007u + k);
      file = (scratch / "scene.prm").string();
      std::ofstream(file, std::ios::binary) << text;
    }
    where_it_is = file.c_str();
    alarm(seconds);
    try
    {
      run_one(file, results, counts);
    }
    catch (const std::exception &e)
    {
      ++failures;
      const std::string kept = keep + "/failure_" + std::to_string(seed) + "_" + std::to_string(k) +
                               fs::path(file).extension().string();
      std::error_code ignored;
      fs::copy_file(file, kept, fs::copy_options::overwrite_existing, ignored);
      std::cout << "FAILURE, input " << k << ", kept as " << kept << ": "
                << std::string(e.what()).substr(0, 2000) << std::endl;
    }
    alarm(0);
    if (!replay.empty())
      break;
    if ((k + 1 - first) % 5000 == 0)
      std::cout << k + 1 - first << " done: " << counts.parsing << " refused in parsing, "
                << counts.ran << " ran, " << failures << " failures" << std::endl;
  }
  const std::size_t all = counts.parsing + counts.validation + counts.start + counts.stepping +
                          counts.ran + counts.large + counts.memory + failures,
                    beyond = all - counts.parsing;
  std::cout << all << " inputs: refused in parsing " << counts.parsing
            << ", in scene and form finding " << counts.validation << ", at the start "
            << counts.start << ", in a step " << counts.stepping << "; ran " << counts.ran
            << "; too large for this test " << counts.large << ", without memory " << counts.memory
            << "; failures " << failures << std::endl;
  if (failures == 0)
  {
    std::error_code ignored;
    fs::remove_all(scratch, ignored);
  }
  if (replay.empty() && 10 * beyond < all)
  {
    std::cout << "less than a tenth reached the scene" << std::endl;
    return 1;
  }
  return failures > 0 ? 1 : 0;
}
