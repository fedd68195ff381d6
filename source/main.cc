// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/simulation/simulation.h>

#include <boost/program_options.hpp>

#include <iostream>

int main(int argc, char **argv)
{
  namespace po = boost::program_options;
  po::options_description options("Options");
  options.add_options()("help,h", "print this text")(
      "set,s", po::value<std::vector<std::string>>()->composing(),
      "change an entry of the file: Section.Entry=value; may be repeated")(
      "file", po::value<std::string>(), "parameter file (.prm)");
  po::positional_options_description positional;
  positional.add("file", 1);
  try
  {
    po::variables_map arguments;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positional).run(),
              arguments);
    po::notify(arguments);
    if (arguments.count("help") || !arguments.count("file"))
    {
      std::cout << "Usage: taut FILE.prm [options]\n" << options;
      return arguments.count("help") ? 0 : 1;
    }
    taut::Parameters parameters;
    parameters.read(arguments["file"].as<std::string>(),
                    arguments.count("set") ? arguments["set"].as<std::vector<std::string>>()
                                           : std::vector<std::string>());
    taut::Simulation(parameters, std::cout).run();
    return 0;
  }
  catch (const po::error &e)
  {
    std::cerr << "taut: " << e.what() << "; see taut --help\n";
  }
  catch (const taut::UserError &e)
  {
    std::cerr << "taut: " << e.what() << '\n';
  }
  catch (const std::exception &e)
  {
    std::cerr << "taut: internal error: " << e.what() << '\n';
  }
  return 1;
}
