// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: whatever calls a program makes, they give exact results or a UserError of one line that
// names what is wrong, and leave no trace then. Source: systems at rest by statics; free fall and a
// mass on a spring by backward Euler and the trapezoidal rule for one number.
#include "library_systems.h"

#include <boost/program_options.hpp>

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <iostream>

namespace
{
  using namespace library;

  volatile std::sig_atomic_t sequence = 0;

  void report_signal(const int signal)
  {
    char text[] = "CRASH or HANG, signal 00, in sequence 00000000\n";
    text[22] = static_cast<char>('0' + signal / 10);
    text[23] = static_cast<char>('0' + signal % 10);
    int n = sequence;
    for (std::size_t i = std::strlen(text) - 2; text[i] == '0'; --i, n /= 10)
      text[i] = static_cast<char>('0' + n % 10);
    _exit(write(STDERR_FILENO, text, std::strlen(text)) < 0 ? 3 : 2);
  }

  void run(const std::uint64_t seed, Counts &counts)
  {
    Calls calls(seed, counts);
    Script script(calls, calls.below(4) == 0 ? 0. : .7);
    const std::size_t kind = calls.below(10);
    if (kind < 5)
      script.rest();
    else if (kind < 8)
      script.motion();
    else
      script.extremes();
  }
} // namespace

int main(int argc, char **argv)
{
  namespace po = boost::program_options;
  std::size_t count = 300, first = 0;
  std::uint64_t seed = 1;
  unsigned int seconds = 60;
  po::options_description options("Options");
  options.add_options()("count", po::value(&count), "number of sequences")(
      "first", po::value(&first), "number of the first one")(
      "seed", po::value(&seed), "of the random numbers")("seconds", po::value(&seconds),
                                                         "limit of one sequence [s]");
  po::variables_map arguments;
  po::store(po::parse_command_line(argc, argv, options), arguments);
  po::notify(arguments);
  for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS})
    std::signal(signal, report_signal);
  Counts counts;
  std::size_t failures = 0;
  for (std::size_t k = first; k < first + count; ++k)
  {
    sequence = static_cast<std::sig_atomic_t>(k);
    alarm(seconds);
    try
    {
      run(seed * 1000000007u + k, counts);
    }
    catch (const std::exception &e)
    {
      ++failures;
      std::cout << "FAILURE, --seed " << seed << " --first " << k << " --count 1: " << e.what()
                << std::endl;
    }
  }
  alarm(0);
  const std::size_t all = counts.checked + counts.refused + counts.open;
  std::cout << count << " sequences, " << all << " calls: " << counts.checked
            << " valid ones with their result, " << counts.refused << " refused, " << counts.open
            << " with extreme numbers; failures " << failures << std::endl;
  if (10 * counts.checked < 4 * all || 10 * counts.refused < all)
  {
    std::cout << "fewer than 40 % of the calls are valid, or than 10 % are mistakes" << std::endl;
    return 1;
  }
  return failures > 0 ? 1 : 0;
}
