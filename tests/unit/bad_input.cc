// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a mistake in the input is one error of one line that names file, line, entry, value and
// remedy; results of an earlier run are as they were. Source: the table below; each case changes a
// scene that runs.
#include <taut/simulation/simulation.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
  namespace fs = std::filesystem;
  using Texts = std::vector<std::string>;
  using Changes = std::vector<std::pair<std::string, std::string>>;

  const char *const network = R"(set Generator = network
set Start     = equilibrium
subsection Network
  set Wires        = line, arm
  set Supports     = ends, clamp, clamp slope
  set Point masses = clip
  set Masses       = block
  set Springs      = spring
  set Links        = hanger, stop
  set Loads        = push
  subsection Wire line
    set From            = 0, 0
    set To              = 10, 0
    set Components      = string
    set Mass per length = 1
    set Tension         = 1000
    set Element size    = 1
  end
  subsection Wire arm
    set From              = 0, 2
    set To                = 4, 2
    set Components        = beam
    set Mass per length   = 2
    set Bending stiffness = 500
    set Element size      = 0.5
  end
  subsection Support ends
    set Wire      = line
    set Positions = 0, 10
  end
  subsection Support clamp
    set Wire      = arm
    set Positions = 0
  end
  subsection Support clamp slope
    set Wire   = arm
    set Motion = slope
  end
  subsection Point mass clip
    set Wire      = line
    set Positions = 5
    set Mass      = 0.5
  end
  subsection Mass block
    set Position = 3, -1
    set Motions  = y
    set Mass     = 3
  end
  subsection Spring spring
    set From      = ground
    set To        = block
    set Stiffness = 600
  end
  subsection Link hanger
    set Type      = dropper
    set From      = arm @ 3
    set To        = line @ 3
    set Stiffness = 1e4
  end
  subsection Link stop
    set Type      = stop
    set From      = block
    set To        = line @ 6
    set Direction = 0, 1
    set Stiffness = rigid
    set Gap       = 0.5
  end
  subsection Load push
    set On        = block
    set Magnitude = 10*t
  end
end
subsection Time
  set Scheme = automatic
  set Step   = 0.01
  set End    = 0.05
  subsection Newmark
    set Beta = 0.25
  end
  subsection Generalised-alpha
    set Spectral radius = 0.8
  end
end
subsection Output
  set Folder = results
  set Probes = middle
  subsection Probe middle
    set Point = line @ 5
  end
end
subsection Statistics
  set Window =
end
)";

  const char *const catenary = R"(set Generator = catenary
subsection Catenary
  set Number of spans = 2
  set Span length     = 20
  subsection Contact wire
    set Element size = 2
  end
  subsection Messenger wire
    set Element size = 2
  end
  subsection Droppers
    set Positions = 5, 10, 15
    set Pre-sag   =
    set Lengths   =
  end
  set Uplift positions = 20
  set Pantographs      = one
  subsection Pantograph one
    set Masses      = 7, 15
    set Stiffnesses = 4200, 50
    set Dampings    = 10, 90
    set Start       = 5
    set Speed       = 100
  end
end
subsection Time
  set Step = 0.01
  set End  = 0.05
end
subsection Output
  set Folder = results
end
)";

  /// What is wrong, the changes that make it so, and what the message has to say. A line of the
  /// scene that ends with
  /// "# here" is the one that the message has to name.
  struct Case
  {
    const char *name;
    const char *scene;
    Changes changes;
    Texts fragments;
    bool in_run = false; ///< the mistake shows while the run is on its way, with its results begun
  };

  const char *const whole = ""; ///< the text is that of the only change

  const std::vector<Case> &table()
  {
    static const std::vector<Case> cases = {
        // Structure of the file
        {"unknown_entry",
         network,
         {{"set Tension  ", "set Tensoin # here\n#"}},
         {"cannot read", "set Tensoin"}},
        {"misspelt_entry",
         network,
         {{"set Tension         = 1000", "set Tensoin = 1000 # here"}},
         {"there is no entry 'Tensoin' in 'Wire line'", "did you mean 'Tension'"}},
        {"misspelt_section",
         network,
         {{"subsection Wire line", "subsection Wire lime # here"}},
         {"there is no section 'Wire lime'", "did you mean 'Wire line'"}},
        {"section_without_its_name_in_the_list",
         network,
         {{"set Loads        = push", "set Loads ="},
          {"subsection Load push", "subsection Load push # here"}},
         {"there is no section 'Load push' in 'Network'", "add 'push' to the names in 'Loads'"}},
        {"duplicate_entry",
         network,
         {{"    set Positions = 0, 10", "    set Positions = 0, 10\nset Positions = 1 # here"}},
         {"Network/Support ends/Positions", "was set before, at", "remove one"}},
        {"missing_end",
         network,
         {{"subsection Statistics", "subsection Statistics # here"},
          {"set Window =\nend", "set Window ="}},
         {"Statistics", "never closed", "add 'end'"}},
        {"stray_end",
         network,
         {{"subsection Statistics\n", "end # here\nsubsection Statistics\n"}},
         {"'end' without a 'subsection'"}},
        {"nonsense_line",
         network,
         {{"subsection Statistics\n", "hello # here\nsubsection Statistics\n"}},
         {"cannot read 'hello'", "set Name = value"}},
        {"entry_without_name",
         network,
         {{"set Gap       = 0.5", "set = 0.5 # here"}},
         {"the name of an entry", "empty"}},
        {"trailing_backslash",
         whole,
         {{"", "set Start = equilibrium \\\\ # here\n"}},
         {"Start", "continues a line"}},
        {"binary",
         whole,
         {{"", std::string("set A = 1\n\x7f"
                           "ELF\x02\x01 # here\n")}},
         {"not text", "byte 0x7f"}},
        {"binary_with_zero",
         whole,
         {{"", std::string("set A = 1\n\0 # here\n", 20)}},
         {"not text", "byte 0x00"}},
        {"latin_1",
         network,
         {{"set Wires        = line, arm", "set Wires = l\xfc"
                                           "ne, arm # here"}},
         {"not text", "byte 0xfc", "UTF-8"}},
        {"sections_without_end",
         whole,
         {{"",
           "subsection a\nsubsection a\nsubsection a\nsubsection a\nsubsection a\nsubsection a\n"
           "subsection a\nsubsection a\nsubsection a\nsubsection a\nsubsection a\nsubsection "
           "a\nsubsection a\nsubsection a\n"
           "subsection a\nsubsection a\nsubsection a\nsubsection a\nsubsection a\nsubsection "
           "a\nsubsection a # here\n"}},
         {"more than 20 sections", "'end'"}},
        {"include_of_a_missing_file",
         whole,
         {{"", "set Start = given\ninclude nowhere.prm # here\n"}},
         {"cannot include", "nowhere.prm", "no such file"}},
        {"include_of_a_folder",
         whole,
         {{"", "include results # here\n"}},
         {"cannot include", "no such file"}},
        {"include_loop",
         whole,
         {{"", "\ninclude scene.prm # here\n"}},
         {"cannot include", "include itself", "remove"}},

        // Types
        {"ill_typed_number",
         network,
         {{"= 1000", "= 1 kN # here"}},
         {"Network/Wire line/Tension = '1 kN'", "a number", "the number alone"}},
        {"decimal_comma",
         network,
         {{"= 1000", "= 1000,5 # here"}},
         {"Network/Wire line/Tension = '1000,5'", "decimals have a point"}},
        {"link_without_end",
         network,
         {{"set To        = line @ 3", "set To = # here"}},
         {"Network/Link hanger/To", "it says not where", "line @ position"}},
        {"ball_joint_with_direction",
         network,
         {{"set Type      = stop", "set Type = ball joint"},
          {"    set Direction = 0, 1\n    set Stiffness = rigid",
           "    set Direction = 0, 1 # here\n    set Stiffness = rigid"}},
         {"Network/Link stop/Direction", "ball joint", "take a joint"}},
        {"nan",
         network,
         {{"= 1000", "= nan # here"}},
         {"Network/Wire line/Tension = 'nan'", "not allowed"}},
        {"inf",
         network,
         {{"= 1000", "= inf # here"}},
         {"Network/Wire line/Tension = 'inf'", "not allowed"}},
        {"overflow",
         network,
         {{"= 1000", "= 1e999 # here"}},
         {"Network/Wire line/Tension = '1e999'", "not allowed"}},
        {"negative_tension",
         network,
         {{"= 1000", "= -1000 # here"}},
         {"Tension = '-1000'", "at least 0"}},
        {"list_too_short",
         network,
         {{"set To              = 10, 0", "set To = 10 # here"}},
         {"Wire line/To = '10'", "a list of 2 to 3 elements"}},
        {"list_too_long",
         network,
         {{"set To              = 10, 0", "set To = 10, 0, 0, 0 # here"}},
         {"Wire line/To = '10, 0, 0, 0'", "a list of 2 to 3 elements"}},
        {"lateral_component_alone",
         network,
         {{"set Components        = beam", "set Components = bar, lateral # here"}},
         {"Wire arm/Components = 'bar, lateral'", "string's or a beam's", "add one of them"}},
        {"support_of_a_lateral_motion_that_is_not_there",
         network,
         {{"set Wire      = line", "set Wire = line\n    set Motion = lateral # here"}},
         {"Support ends/Motion = 'lateral'", "wire 'line' has no component lateral"}},
        {"support_of_a_lateral_slope_of_a_string",
         network,
         {{"= string", "= string, lateral"},
          {"set Wire      = line", "set Wire = line\n    set Motion = lateral slope # here"}},
         {"Support ends/Motion = 'lateral slope'", "wire 'line' has no slope"}},
        {"spring_along_z_at_a_mass_that_does_not_move_there",
         network,
         {{"set Stiffness = 600", "set Stiffness = 600\n    set Direction = 0, 0, 1 # here"}},
         {"Spring spring/Direction = '0, 0, 1'", "mass 'block' cannot move in the direction"}},
        {"link_along_z_where_nothing_moves_there",
         network,
         {{"set Direction = 0, 1", "set Direction = 0, 0, 1 # here"}},
         {"Link stop/Direction = '0, 0, 1'", "neither end can move along it"}},
        {"body_of_an_unknown_type",
         network,
         {{"set Generator = network", "set Generator = network\nset Bodies = plate\nsubsection "
                                      "Body plate\n  set Type = plait # here\nend"}},
         {"Body plate/Type = 'plait'", "there is no such type; known are: cable, rigid body, solid",
          "Additional shared libraries"}},
        {"rigid_body_without_moments",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = bar\nsubsection Body bar\n  set Type = rigid "
           "body\n  set Mass = 2\n  set Moments of inertia = 1, 1 # here\nend"}},
         {"Body bar/Moments of inertia = '1, 1'", "needs three"}},
        {"rigid_body_that_cannot_be",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = bar\nsubsection Body bar\n  set Type = rigid "
           "body\n  set Mass = 2\n  set Moments of inertia = 1, 1, 3 # here\nend"}},
         {"Body bar/Moments of inertia = '1, 1, 3'", "more than the two others together"}},
        {"rigid_body_with_skew_axes",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = bar\nsubsection Body bar\n  set Type = rigid "
           "body\n  set Mass = 2\n  set Moments of inertia = 1, 1, 1\n  set Second axis = 1, 1 # "
           "here\nend"}},
         {"Body bar/Second axis = '1, 1'", "not across the First axis"}},
        {"rigid_body_that_nothing_holds",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = bar\nsubsection Body bar # here\n  set Type = "
           "rigid body\n  set Mass = 2\n  set Moments of inertia = 1, 1, 1\nend"}},
         {"static equilibrium", "body 'bar'", "nothing holds"}},
        {"table_of_rigid_bodies_without_one",
         network,
         {{"set Folder", "set Observers = rigid bodies # here\n  set Folder"}},
         {"Output/Observers = 'rigid bodies'", "no rigid body"},
         true},
        {"solid_without_stiffness",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = solid\nset Contacts = wall\nsubsection Body "
           "solid\n  set Type = solid\n  set Young's modulus = 0 # here\nend\nsubsection Contact "
           "wall\n  set Slave = solid: 0\n  set Obstacle = plane\nend"}},
         {"Young's modulus = '0'", "needs a positive one [Pa]"}},
        {"boundary_that_a_mesh_does_not_have",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = solid\nset Contacts = wall\nsubsection Body "
           "solid\n  set Type = solid\n  set Young's modulus = 1e9\n  set Fixed boundaries = 7 # "
           "here\nend\nsubsection Contact wall\n  set Slave = solid: 0\n  set Obstacle = "
           "plane\nend"}},
         {"Fixed boundaries = '7'", "the mesh has no boundary 7; it has 0 1 2 3"}},
        {"boundary_that_is_fixed_and_moved",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = solid\nset Contacts = wall\nsubsection Body "
           "solid\n  set Type = solid\n  set Young's modulus = 1e9\n  set Fixed boundaries = 1\n  "
           "set Displacement = 1: , 1e-3 # here\nend\nsubsection Contact wall\n  set Slave = "
           "solid: 0\n  set Obstacle = plane\nend"}},
         {"Displacement = '1: , 1e-3'", "boundary 1 is held along y by",
          "Fixed boundaries' as well"}},
        {"one_contact_listed_twice",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = solid\nset Contacts = wall, again\nsubsection "
           "Body solid\n  set Type = solid\n  set Young's modulus = 1e9\nend\nsubsection Contact "
           "wall\n  set Slave = solid: 0\n  set Obstacle = plane\nend\nsubsection Contact again "
           "# here\n  set Slave = solid: 3, 0\n  set Obstacle = plane\nend"}},
         {"Contact again", "'Contact wall' has the same two sides"}},
        {"contact_of_an_unknown_body",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = solid\nset Contacts = wall\nsubsection Body "
           "solid\n  set Type = solid\n  set Young's modulus = 1e9\nend\nsubsection Contact wall\n "
           " set Slave = sollid: 0 # here\n  set Obstacle = plane\nend"}},
         {"Contact wall/Slave = 'sollid: 0'", "known are: solid"}},
        {"traction_with_too_few_components",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = solid\nset Contacts = wall\nsubsection Body "
           "solid\n  set Type = solid\n  set Young's modulus = 1e9\n  set Traction = 1: 3 # "
           "here\nend\nsubsection Contact wall\n  set Slave = solid: 0\n  set Obstacle = "
           "plane\nend"}},
         {"Traction = '1: 3'", "1 components where the solid has 2"}},
        {"moving_obstacle",
         network,
         {{"set Generator = network",
           "set Generator = network\nset Bodies = solid\nset Contacts = wall\nsubsection Body "
           "solid\n  set Type = solid\n  set Young's modulus = 1e9\nend\nsubsection Contact wall\n "
           " set Slave = solid: 0\n  set Obstacle = height\n  set Height = 0.1*t # here\nend"}},
         {"Contact wall/Height", "an obstacle does not move"}},
        {"unknown_observer",
         network,
         {{"subsection Output", "subsection Output\n  set Observers = enerhy # here"}},
         {"Output/Observers = 'enerhy'", "did you mean 'energy'"}},
        {"unknown_generator",
         network,
         {{"set Generator = network", "set Generator = netwerk # here"}},
         {"Generator = 'netwerk'", "catenary", "did you mean 'network'"}},
        {"unknown_scheme",
         network,
         {{"= automatic", "= newmark beta # here"}},
         {"Time/Scheme = 'newmark beta'", "BDF2", "did you mean 'Newmark'"}},
        {"unknown_component",
         network,
         {{"= string", "= strong # here"}},
         {"Components = 'strong'", "did you mean 'string'"}},
        {"bad_bool",
         network,
         {{"set Mass      = 0.5", "set Mass = 0.5\nset Weight = perhaps # here"}},
         {"Weight = 'perhaps'", "boolean"}},
        {"fractional_degree",
         network,
         {{"set Tension ", "set Degree = 1.5 # here\nset Tension "}},
         {"Degree = '1.5'", "integer"}},

        // Formulas
        {"formula_with_unknown_function",
         network,
         {{"= 10*t", "= 10*sine(t) # here"}},
         {"Load push/Magnitude = '10*sine(t)'", "sine", "formula in t"}},
        {"formula_unfinished",
         network,
         {{"= 10*t", "= 10*( # here"}},
         {"Load push/Magnitude", "cannot evaluate"}},
        {"formula_empty",
         network,
         {{"= 10*t", "= # here"}},
         {"Load push/Magnitude", "cannot evaluate", "formula in t"}},
        {"two_formulas",
         network,
         {{"= 10*t", "= 1; 2 # here"}},
         {"Load push/Magnitude", "one formula"}},
        {"formula_of_a_position_on_a_mass",
         network,
         {{"= 10*t", "= 10*s # here"}},
         {"Load push/Magnitude", "does not depend on s", "formula in t"}},
        {"speed_of_a_load_that_stands",
         network,
         {{"= 10*t", "= 10*t\nset Speed = 3 # here"}},
         {"Load push/Speed = '3'", "Type = moving"}},
        {"formula_infinite_at_the_start",
         network,
         {{"= 10*t", "= 1/t # here"}},
         {"Load push/Magnitude", "not finite", "t = 0", "if(condition"}},
        {"formula_not_a_number_at_the_start",
         network,
         {{"= 10*t", "= sqrt(-1) # here"}},
         {"Load push/Magnitude", "not finite"}},
        {"number_too_large_in_a_formula",
         network,
         {{"= 10*t", "= 1e999 # here"}},
         {"Load push/Magnitude", "out of range"}},
        {"formula_not_a_number_in_the_run",
         network,
         {{"= 10*t", "= sqrt(0.025-t) # here"}},
         {"Load push/Magnitude", "not finite", "t = 0.03", "if(condition"},
         true},

        {"formula_that_is_random",
         network,
         {{"= 10*t", "= 10*rand() # here"}},
         {"Load push/Magnitude", "'rand' is random"}},
        {"formula_that_is_random_from_a_seed",
         network,
         {{"= 10*t", "= rand_seed(1) # here"}},
         {"Load push/Magnitude", "'rand_seed' is random"}},
        {"profile_that_is_a_file",
         catenary,
         {{"set Start       = 5", "set Start = 5\nset Height profile = measured.csv # here"}},
         {"Pantograph one/Height profile = 'measured.csv'", "name of a file", "no file is read",
          "formula in s (position along the wire [m]), e.g."}},
        {"profile_of_time",
         catenary,
         {{"set Start       = 5", "set Start = 5\nset Height profile = 0.001*sin(t) # here"}},
         {"Pantograph one/Height profile", "does not depend on t", "formula in s"}},
        {"support_that_depends_on_the_position",
         network,
         {{"set Positions = 0, 10", "set Positions = 0, 10\nset Displacement = 0.01*s # here"}},
         {"Support ends/Displacement", "does not depend on s", "formula in t"}},

        // Names
        {"pantograph_without_its_section",
         catenary,
         {{"set Pantographs      = one", "set Pantographs = one, two # here"}},
         {"Catenary/Pantographs = 'one, two'", "no section 'Pantograph two'", "remove 'two'"}},
        {"wire_without_its_section",
         network,
         {{"set Wires        = line, arm", "set Wires = line, arm, rope # here"}},
         {"Network/Wires", "no section 'Wire rope'"}},
        {"links_that_are_one_name_in_tables",
         network,
         {{"set Links        = hanger, stop", "set Links = hanger, stop, sto-p"},
          {"subsection Load push",
           "subsection Link sto-p # here\nset From = block\nset To = line @ 7\nset Direction = 0, "
           "1\nend\nsubsection Load push"}},
         {"Network/Link sto-p", "'stop' and 'sto-p'", "one name", "rename one"}},
        {"supports_that_are_one_name_in_tables",
         network,
         {{"set Supports     = ends, clamp, clamp slope",
           "set Supports = ends, clamp, clamp_slope, "
           "clamp slope"},
          {"  subsection Support clamp slope",
           "  subsection Support clamp_slope\nset Wire = arm\nset Positions = 4\nset Type = "
           "elastic\nset Stiffness = 1\nend\n  subsection Support clamp slope # here"}},
         {"Network/Support clamp slope", "'clamp_slope' and 'clamp slope'", "rename one"}},
        {"name_with_at_sign",
         network,
         {{"set Wires        = line, arm", "set Wires = li@ne, arm # here"}},
         {"Network/Wires", "'li@ne' cannot be a name"}},
        {"name_twice",
         network,
         {{"set Wires        = line, arm", "set Wires = line, arm, line # here"}},
         {"Network/Wires", "'line' comes twice"}},
        {"empty_name",
         network,
         {{"set Wires        = line, arm", "set Wires = line, , arm # here"}},
         {"Network/Wires", "cannot be a name"}},
        {"nothing_but_a_comma",
         network,
         {{"set Loads        = push", "set Loads = , # here"},
          {"subsection Load push", "subsection Load"}},
         {"Network/Loads", "'' cannot be a name"}},
        {"pantographs_nothing_but_a_comma",
         catenary,
         {{"set Pantographs      = one", "set Pantographs = , # here"},
          {"subsection Pantograph one", "subsection Pantograph"}},
         {"Catenary/Pantographs", "'' cannot be a name"}},
        {"two_commas_at_the_end",
         catenary,
         {{"set Pantographs      = one", "set Pantographs = one,, # here"}},
         {"Catenary/Pantographs", "'' cannot be a name"}},
        {"pantograph_with_slash",
         catenary,
         {{"set Pantographs      = one", "set Pantographs = on/e # here"}},
         {"Catenary/Pantographs", "'on/e' cannot be a name"}},
        {"pantograph_twice",
         catenary,
         {{"set Pantographs      = one", "set Pantographs = one, one # here"}},
         {"Catenary/Pantographs", "comes twice"}},
        {"unknown_wire_of_a_support",
         network,
         {{"set Wire      = arm", "set Wire = arn # here"}},
         {"Support clamp/Wire = 'arn'", "not a wire", "did you mean 'arm'"}},
        {"unknown_wire_of_a_link",
         network,
         {{"= arm @ 3", "= arn @ 3 # here"}},
         {"Link hanger/From", "not known", "did you mean 'arm'"}},
        {"unknown_mass",
         network,
         {{"set To        = block", "set To = blok # here"}},
         {"Spring spring/To", "not known", "did you mean 'block'"}},
        {"mass_named_as_a_wire",
         network,
         {{"set Masses       = block", "set Masses = block, line"},
          {"subsection Load push", "subsection Mass line # here\nend\nsubsection Load push"}},
         {"Mass line", "taken by a wire"}},

        // Numbers that make no sense
        {"negative_mass",
         network,
         {{"set Mass     = 3", "set Mass = -3 # here"}},
         {"Mass block/Mass = '-3'", "at least 0"}},
        {"negative_stiffness",
         network,
         {{"= 600", "= -600 # here"}},
         {"Spring spring/Stiffness = '-600'", "at least 0"}},
        {"negative_link_stiffness",
         network,
         {{"= 1e4", "= -1e4 # here"}},
         {"Link hanger/Stiffness", "positive", "rigid"}},
        {"law_of_a_rigid_link_and_a_stiffness",
         network,
         {{"set Stiffness = 1e4",
           "set Stiffness = 1e4\nset Law points = 1: 2\nset Law = table # here"}},
         {"Link hanger/Law", "leave Stiffness 'rigid'"}},
        {"law_of_a_joint",
         network,
         {{"set Type      = dropper",
           "set Type = joint\nset Law points = 1: 2\nset Law = table # here"}},
         {"Link hanger/Law", "only push or pull", "Stiffness"}},
        {"law_without_points",
         network,
         {{"set Stiffness = rigid", "set Law = table\nset Law points = # here"}},
         {"Link stop/Law points", "has a point beyond 0:0"}},
        {"law_with_points_that_decrease",
         network,
         {{"set Stiffness = rigid", "set Law = table\nset Law points = 0.1: 5, 0.2: 4 # here"}},
         {"Link stop/Law points", "'0.2: 4'", "both increase"}},
        {"law_with_a_dead_zone",
         network,
         {{"set Stiffness = rigid", "set Law = table\nset Law points = 0.1: 0, 0.2: 4 # here"}},
         {"Link stop/Law points", "dead zone is a Gap"}},
        {"law_with_words_for_points",
         network,
         {{"set Stiffness = rigid", "set Law = table\nset Law points = 0.1: much # here"}},
         {"Link stop/Law points", "two numbers"}},
        {"law_with_points_without_forces",
         network,
         {{"set Stiffness = rigid", "set Law = table\nset Law points = 0.1, 0.2 # here"}},
         {"Link stop/Law points", "'elongation: force'"}},
        {"points_of_no_law",
         network,
         {{"set Stiffness = rigid", "set Law points = 0.1: 5 # here"}},
         {"Link stop/Law points", "'Law = table'"}},
        {"formula_of_no_law",
         network,
         {{"set Stiffness = rigid", "set Law formula = 5*d # here"}},
         {"Link stop/Law formula", "'Law = formula'"}},
        {"law_without_a_range",
         network,
         {{"set Stiffness = rigid", "set Law = formula\nset Law formula = 5*d # here"}},
         {"Link stop/Law formula", "give Law range"}},
        {"law_of_something_else",
         network,
         {{"set Stiffness = rigid",
           "set Law = formula\nset Law range = 1\nset Law formula = 5*s # here"}},
         {"Link stop/Law formula", "formula in d"}},
        {"law_with_a_force_at_zero",
         network,
         {{"set Stiffness = rigid",
           "set Law = formula\nset Law range = 1\nset Law formula = 5*d + 2 # here"}},
         {"Link stop/Law formula", "is 2 at d = 0"}},
        {"law_that_does_not_increase",
         network,
         {{"set Stiffness = rigid",
           "set Law = formula\nset Law range = 1\nset Law formula = d - d^2 # here"}},
         {"Link stop/Law formula", "does not increase from d = 0.5"}},
        {"law_that_is_not_finite",
         network,
         {{"set Stiffness = rigid",
           "set Law = formula\nset Law range = 1\nset Law formula = d/(1-d) # here"}},
         {"Link stop/Law formula", "not finite at d = 1"}},
        {"negative_damping",
         network,
         {{"= 600", "= 600\nset Damping = -1 # here"}},
         {"Spring spring/Damping = '-1'", "at least 0"}},
        {"wire_without_length",
         network,
         {{"= 10, 0", "= 0, 0 # here"}},
         {"Wire line/To", "give it a length"}},
        {"wire_beyond_all_lengths",
         network,
         {{"= 10, 0", "= 1e300, 0 # here"}},
         {"Wire line/To", "at most"}},
        {"wire_far_from_the_origin",
         network,
         {{"    set From            = 0, 0\n    set To              = 10, 0",
           "    set From = 1e12, 0 # here\n    set To = 1000000000010, 0"}},
         {"Wire line/From", "origin"}},
        {"wire_without_mass",
         network,
         {{"set Mass per length = 1", "set Mass per length = 0 # here"}},
         {"Wire line/Mass per length = '0'", "positive"}},
        {"element_size_zero",
         network,
         {{"set Element size    = 1", "set Element size = 0 # here"}},
         {"Wire line/Element size = '0'", "positive"}},
        {"too_many_elements",
         network,
         {{"set Element size    = 1", "set Element size = 1e-9 # here"}},
         {"Wire line/Element size", "too many"}},
        {"string_without_tension",
         network,
         {{"= 1000", "= 0 # here"}},
         {"Wire line/Tension = '0'", "string needs a positive"}},
        {"beam_without_stiffness",
         network,
         {{"set Bending stiffness = 500", "set Bending stiffness = 0 # here"}},
         {"Wire arm/Bending stiffness = '0'", "string"}},
        {"bar_without_stiffness",
         network,
         {{"= string", "= bar, string"}, {"subsection Wire line", "subsection Wire line # here"}},
         {"Wire line/Axial stiffness", "bar needs a positive"}},
        {"string_and_beam",
         network,
         {{"= string", "= string, beam # here"}},
         {"Wire line/Components", "exclude each other"}},
        {"no_component",
         network,
         {{"= string", "= # here"}},
         {"Wire line/Components", "name at least one"}},
        {"elastic_support_of_nothing",
         network,
         {{"    set Motion = slope", "    set Motion = slope\n    set Type = elastic"},
          {"subsection Support clamp slope", "subsection Support clamp slope # here"}},
         {"Stiffness", "elastic support needs"}},
        {"inertia_without_rotation",
         network,
         {{"set Mass     = 3", "set Mass = 3\nset Inertia = 1 # here"}},
         {"Mass block/Inertia", "rotation"}},

        // Places and motions
        {"position_outside_of_the_wire",
         network,
         {{"set Positions = 5", "set Positions = 11 # here"}},
         {"Point mass clip/Positions", "outside wire 'line'", "0 to 10"}},
        {"no_position",
         network,
         {{"set Positions = 5", "set Positions = # here"}},
         {"Point mass clip/Positions", "no position"}},
        {"bad_range",
         network,
         {{"set Positions = 5", "set Positions = 0:0:5 # here"}},
         {"Point mass clip/Positions", "first:step:last"}},
        {"half_a_range",
         network,
         {{"set Positions = 5", "set Positions = 0:5 # here"}},
         {"Point mass clip/Positions", "neither a number nor a range"}},
        {"link_outside_of_the_wire",
         network,
         {{"= arm @ 3", "= arm @ 5 # here"}},
         {"Link hanger/From", "outside wire 'arm'", "0 to 4"}},
        {"wire_without_position",
         network,
         {{"= arm @ 3", "= arm # here"}},
         {"Link hanger/From", "arm @ position"}},
        {"moment_on_a_string",
         network,
         {{"set Gap       = 0.5", "set Gap = 0.5\nset Rotational = true"},
          {"set From      = block", "set From = ground"},
          {"= line @ 6\n    set Direction = 0, 1", "= line @ 6 # here"}},
         {"Link stop/To", "no slope", "beam"}},
        {"angular_stop_along_a_direction",
         network,
         {{"set Gap       = 0.5", "set Gap = 0.5\nset Rotational = true"},
          {"= line @ 6\n    set Direction = 0, 1", "= line @ 6\n    set Direction = 0, 1 # here"}},
         {"Link stop/Direction", "rotational", "Axis"}},
        {"moment_along_a_direction",
         network,
         {{"set On        = block",
           "set On = block\nset Rotational = true\nset Direction = 1, 0 # here"}},
         {"Load push/Direction", "rotational", "Axis"}},
        {"moment_on_a_mass_that_does_not_turn",
         network,
         {{"set On        = block", "set On = block # here\nset Rotational = true"}},
         {"Load push/On", "does not rotate", "add 'rotation'"}},
        {"support_of_a_motion_that_is_not",
         network,
         {{"    set Motion = slope", "    set Motion = axial # here"}},
         {"Support clamp slope/Motion", "no component bar"}},
        {"slope_of_a_string",
         network,
         {{"set Positions = 0, 10", "set Positions = 0, 10\nset Motion = slope # here"}},
         {"Support ends/Motion", "no slope"}},
        {"two_supports_of_one_motion",
         network,
         {{"    set Motion = slope", "    set Motion = transverse\n    set Positions = 0 # here"}},
         {"Positions", "held there already", "remove one"}},
        {"one_support_twice_at_one_place",
         network,
         {{"set Positions = 0, 10", "set Positions = 0, 10, 10 # here"}},
         {"Support ends/Positions", "held there already"}},
        {"link_from_ground_to_ground",
         network,
         {{"set From      = block", "set From = ground"}, {"= line @ 6", "= ground # here"}},
         {"Link stop/To", "both ends are the ground"}},
        {"link_of_a_point_to_itself",
         network,
         {{"= line @ 6", "= line @ 6 # here"}, {"set From      = block", "set From = line @ 6"}},
         {"Link stop/To", "same point"}},
        {"link_across_every_motion",
         network,
         {{"= 0, 1\n    set Stiffness = rigid", "= 1, 0 # here\n    set Stiffness = rigid"}},
         {"Link stop/Direction", "neither end can move"}},
        {"load_across_every_motion",
         network,
         {{"set On        = block", "set On = block\nset Direction = 1, 0 # here"}},
         {"Load push/Direction", "cannot move along it"}},
        {"load_on_the_ground",
         network,
         {{"set On        = block", "set On = ground # here"}},
         {"Load push/On", "moves nothing"}},
        {"probe_across_every_motion",
         network,
         {{"set Point = line @ 5", "set Point = line @ 5\nset Direction = 1, 0 # here"}},
         {"Probe middle/Direction", "cannot move along it"}},
        {"direction_zero",
         network,
         {{"= 0, 1\n    set Stiffness = rigid", "= 0, 0 # here\n    set Stiffness = rigid"}},
         {"Link stop/Direction", "not zero"}},
        {"direction_missing",
         network,
         {{"    set Direction = 0, 1\n", ""},
          {"set From      = block", "set From = ground"},
          {"subsection Link stop", "subsection Link stop # here"}},
         {"Link stop/Direction", "give 'x, y'"}},
        {"spring_between_wire_and_mass",
         network,
         {{"set From      = ground", "set From = line @ 3 # here"}},
         {"Spring spring/From", "between masses", "use a link"}},
        {"spring_across_every_motion",
         network,
         {{"= 600", "= 600\nset Direction = 1, 0 # here"}},
         {"Spring spring/Direction", "cannot move"}},
        {"rigid_link_with_damping",
         network,
         {{"set Gap       = 0.5", "set Damping = 1 # here"}},
         {"Link stop/Damping", "finite Stiffness"}},
        {"unequal_numbers_of_ends",
         network,
         {{"subsection Link hanger", "subsection Link hanger # here"},
          {"= arm @ 3", "= arm @ 1, 2, 3"},
          {"= line @ 3", "= line @ 1, 2"}},
         {"Link hanger", "equal numbers"}},
        {"speed_of_a_stop",
         network,
         {{"set Gap       = 0.5", "set Speed = 1 # here"}},
         {"Link stop/Speed", "sliding contact"}},
        {"speed_in_space_of_a_stop",
         network,
         {{"set Gap       = 0.5", "set Straight = true # here"}},
         {"Link stop/Straight", "sliding contact on a cable"}},
        {"contact_leaves_its_wire",
         network,
         {{"= stop\n", "= sliding contact\n"}, {"set Gap       = 0.5", "set Speed = 100 # here"}},
         {"Link stop/Speed", "leaves wire 'line'", "Set Time/End to 0.04 s"}},
        {"contact_on_a_mass",
         network,
         {{"= stop\n", "= sliding contact\n"},
          {"= line @ 6", "= block # here"},
          {"set From      = block", "set From = ground"}},
         {"Link stop/To", "slides on a wire"}},

        {"contact_under_a_bar",
         network,
         {{"= stop\n", "= sliding contact\n"},
          {"= line @ 6", "= line @ 6 # here"},
          {"= string", "= bar"},
          {"set Tension         = 1000", "set Axial stiffness = 1000"},
          {"set Positions = 0, 10", "set Positions = 0, 10\nset Motion = axial"}},
         {"Link stop/To", "wire 'line', which has no transverse motion", "string or beam"}},
        {"two_links_at_one_position",
         network,
         {{"= arm @ 3", "= arm @ 3, 3"}, {"= line @ 3", "= line @ 3, 3 # here"}},
         {"Link hanger/To", "the same two points", "remove one of the positions"}},

        // Catenary
        {"two_droppers_at_one_position",
         catenary,
         {{"= 5, 10, 15", "= 5, 10, 10 # here"}},
         {"Catenary/Droppers/Positions", "two droppers hang at 10 m", "remove one"}},
        {"dropper_beside_a_mast",
         catenary,
         {{"= 5, 10, 15", "= 0.0002, 10"},
          {"subsection Contact wire", "subsection Contact wire # here"},
          {"set Span length     = 20", "set Span length     = 200"}},
         {"0.0002 m long beside others of 2 m", "Move what stands at its two ends"}},
        {"catenary_without_tension",
         catenary,
         {{"  subsection Contact wire\n", "  subsection Contact wire\nset Tension = 0 # here\n"}},
         {"Catenary/Contact wire/Tension = '0'", "positive", "hangs by its tension"}},
        {"span_without_length",
         catenary,
         {{"set Span length     = 20", "set Span length = 0 # here"}},
         {"Catenary/Span length = '0'", "positive"}},
        {"pantograph_before_the_line",
         catenary,
         {{"set Start       = 5", "set Start = -10 # here"}},
         {"Pantograph one/Start = '-10'", "outside the line", "0 to 40 m"}},
        {"pantograph_that_pulls",
         catenary,
         {{"set Start       = 5", "set Start = 5\nset Static force = -120 # here"}},
         {"Pantograph one/Static force = '-120'", "at least 0"}},
        {"two_pantographs_at_one_place",
         catenary,
         {{"set Pantographs      = one", "set Pantographs = one, two"},
          {"set Uplift",
           "subsection Pantograph two\nset Start = 5 # here\nset Speed = 100\nend\nset Uplift"}},
         {"Pantograph two/Start = '5'", "'one' stands at the same place"}},
        {"rigid_contact_with_damping",
         catenary,
         {{"set Start       = 5", "set Start = 5\nset Contact stiffness = rigid\nset Contact "
                                  "damping = 3 # here"}},
         {"Pantograph one/Contact damping = '3'", "finite Contact stiffness"}},
        {"dropper_outside_of_its_span",
         catenary,
         {{"= 5, 10, 15", "= 5, 10, 25 # here"}},
         {"Catenary/Droppers/Positions", "25 m is not inside its span of 20 m"}},
        {"pre_sag_of_other_length",
         catenary,
         {{"set Pre-sag   =", "set Pre-sag = 0, 0.01 # here"}},
         {"Catenary/Droppers/Pre-sag", "2 values for 3"}},
        {"given_lengths_with_stagger",
         catenary,
         {{"  subsection Contact wire\n", "  subsection Contact wire\nset Stagger = 0.2\n"},
          {"set Lengths   =", "set Lengths = 1, 0.9, 1 # here"}},
         {"Catenary/Droppers/Lengths = '1, 0.9, 1'", "in the plane", "give the Pre-sag"}},
        {"wind_that_is_no_formula",
         catenary,
         {{"  subsection Messenger wire\n",
           "  subsection Messenger wire\nset Wind = 3*v # here\n"}},
         {"Catenary/Messenger wire/Wind = '3*v'", "formula in"}},
        {"dropper_that_would_push",
         catenary,
         {{"set Pre-sag   =", "set Pre-sag = 0.1, 0.5, 0.1"},
          {"subsection Droppers", "subsection Droppers # here"}},
         {"dropper '", "would have to push", "remove it"}},
        {"dropper_without_length",
         catenary,
         {{"set Span length     = 20", "set Span length = 20\nset Encumbrance = 0.01"},
          {"subsection Droppers", "subsection Droppers # here"}},
         {"dropper '", "no length", "encumbrance"}},
        {"uplift_outside_of_the_line",
         catenary,
         {{"set Uplift positions = 20", "set Uplift positions = 50 # here"}},
         {"Catenary/Uplift positions", "outside wire 'contact'"}},
        {"pantograph_lists_of_unequal_length",
         catenary,
         {{"= 10, 90", "= 10"}, {"subsection Pantograph one", "subsection Pantograph one # here"}},
         {"Pantograph one", "lists of one length", "2, 2, 1"}},
        {"pantograph_without_mass",
         catenary,
         {{"set Masses      = 7, 15", "set Masses = 0, 0"},
          {"= 4200, 50", "= 0, 0"},
          {"= 10, 90", "= 0, 0"},
          {"subsection Pantograph one", "subsection Pantograph one # here"}},
         {"Pantograph one", "one"}},
        {"no_spans",
         catenary,
         {{"spans = 2", "spans = 0 # here"}},
         {"Number of spans = '0'", "integer"}},

        // Bodies that nothing holds, links that contradict each other
        {"mass_without_support",
         network,
         {{"    set From      = ground\n    set To        = block\n    set Stiffness = 600",
           "    set From = ground\n set To = block\n    set Damping = 600"},
          {"subsection Mass block", "subsection Mass block # here"}},
         {"Mass block", "'block' is not held", "Add a support"}},
        {"beam_without_support",
         network,
         {{"set Supports     = ends, clamp, clamp slope", "set Supports = ends"},
          {"  subsection Support clamp\n    set Wire      = arm\n    set Positions = 0\n  end\n  "
           "subsection Support clamp slope\n    set Wire   = arm\n    set Motion = slope\n  end\n",
           ""},
          {"subsection Wire arm", "subsection Wire arm # here"}},
         {"Wire arm", "is not held", "Add a support"}},
        {"one_sided_support_with_a_lifting_load",
         network,
         {{"    set From      = ground\n    set To        = block\n    set Stiffness = 600",
           "    set From = ground\n set To = block\n    set Damping = 1"},
          {"set From      = block", "set From = ground"},
          {"= line @ 6", "= block"},
          {"= 10*t", "= 100"},
          {"subsection Mass block", "subsection Mass block # here"}},
         {"Mass block", "'block' is not held"}},
        {"joints_with_different_gaps",
         network,
         {{"= hanger, stop", "= hanger, stop, a, b"},
          {"subsection Load push",
           "subsection Link a # here\n set From=ground\nset To = line @ 7\nset Direction=0, "
           "1\nend\nsubsection Link b\n set From=ground\nset To = line @ 7\nset Direction=0, "
           "1\nset Gap = 0.1\nend\nsubsection Load push"}},
         {"static equilibrium", "'a'", "'b'", "contradict each other", "finite stiffness"}},
        {"joint_that_starts_open",
         network,
         {{"= equilibrium", "= undeformed"},
          {"= hanger, stop", "= hanger, stop, a, b"},
          {"subsection Load push",
           "subsection Link a\n set From=ground\nset To = line @ 7\nset Direction=0, "
           "1\nend\nsubsection Link b # here\n set From=ground\nset To = line @ 7\nset "
           "Direction=0, "
           "1\nset Gap = 0.1\nend\nsubsection Load push"}},
         {"Network/Link b", "joint 'b' starts with a gap of 0.1 m", "give it a Stiffness"}},
        {"joint_at_a_support_that_moves",
         network,
         {{"= equilibrium", "= undeformed"},
          {"= hanger, stop", "= hanger, stop, a"},
          {"= ends, clamp,", "= ends, lift, clamp,"},
          {"subsection Load push",
           "subsection Support lift\nset Wire = line\nset Positions = 7\nset Displacement = "
           "t\nend\nsubsection Link a # here\n set From=ground\nset To = line @ 7\nset "
           "Direction=0, "
           "1\nend\nsubsection Load push"}},
         {"at t = 0.01 s", "no force satisfies link 'a'", "finite stiffness"},
         true},
        {"stops_that_overlap",
         network,
         {{"= hanger, stop", "= hanger, stop, a, b"},
          {"subsection Load push",
           "subsection Link a # here\nset Type = stop\n set From=ground\nset To = line @ 7\nset "
           "Direction=0, 1\nset Gap=-0.1\nend\nsubsection Link b\nset Type=stop\n set "
           "From=ground\nset To = line @ 7\nset Direction=0, -1\nset Gap = -0.1\nend\nsubsection "
           "Load push"}},
         {"static equilibrium", "'a'", "'b'", "contradict each other"}},
        {"penetration_at_the_start",
         network,
         {{"= equilibrium", "= undeformed"},
          {"set Gap       = 0.5", "set Gap = -0.5"},
          {"subsection Link stop", "subsection Link stop # here"}},
         {"link 'stop'", "starts with a gap of -0.5", "Change its Gap"}},
        {"stiffness_that_is_a_word",
         network,
         {{"= 1e4", "= stiff # here"}},
         {"Link hanger/Stiffness = 'stiff'", "positive number or 'rigid'"}},
        {"position_outside_by_little",
         network,
         {{"set Positions = 0, 10", "set Positions = 0, 10.0000001 # here"}},
         {"Support ends/Positions", "position 10.0000001 m is outside"}},
        {"cut_of_an_unknown_wire",
         network,
         {{"subsection Statistics\n", "subsection Partition\nset Method = given\nset Cuts = lime @ "
                                      "5 # here\nend\nsubsection Statistics\n"}},
         {"Partition/Cuts = 'lime @ 5'", "lime"}},
        {"cut_outside_of_its_wire",
         network,
         {{"subsection Statistics\n", "subsection Partition\nset Method = given\nset Cuts = line @ "
                                      "50 # here\nend\nsubsection Statistics\n"}},
         {"Partition/Cuts = 'line @ 50'", "line"}},
        {"substructures_by_word",
         network,
         {{"subsection Statistics\n", "subsection Partition\nset Number of substructures = many # "
                                      "here\nend\nsubsection Statistics\n"}},
         {"Partition/Number of substructures = 'many'", "automatic"}},
        {"no_substructures",
         network,
         {{"subsection Statistics\n", "subsection Partition\nset Number of substructures = 0 # "
                                      "here\nend\nsubsection Statistics\n"}},
         {"Partition/Number of substructures = '0'", "1 <= n"}},
        {"load_beyond_all_numbers",
         network,
         {{"= 10*t", "= 1e300"}, {"subsection Wire line", "subsection Wire line # here"}},
         {"static equilibrium", "body 'line (transverse)'", "beyond 1e+100", "Check loads"}},
        {"mass_without_mass",
         network,
         {{"= equilibrium", "= undeformed"},
          {"set Mass     = 3", "set Mass = 0"},
          {"    set From      = ground\n    set To        = block\n    set Stiffness = 600",
           "    set From = ground\n set To = block\n    set Stiffness = 0\nset Damping = 0"},
          {"subsection Spring spring", "subsection Spring spring"}},
         {"Spring spring", "neither Stiffness nor Damping"}},
        {"massless_mass_that_nothing_holds",
         network,
         {{"= equilibrium", "= undeformed"},
          {"= hanger, stop", "= hanger, stop"},
          {"set Masses       = block", "set Masses = block, lost"},
          {"subsection Load push", "subsection Mass lost # here\nend\nsubsection Load push"}},
         {"Mass lost", "nothing holds one of its motions", "Give it mass"}},
        {"massless_mass_and_a_given_scheme",
         network,
         {{"= equilibrium", "= undeformed"},
          {"= automatic", "= BDF2"},
          {"set Masses       = block", "set Masses = block, lost"},
          {"subsection Load push", "subsection Mass lost # here\nend\nsubsection Load push"}},
         {"Mass lost", "nothing holds one of its motions", "Give it mass"}},

        // Study
        {"accuracy_without_a_study",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Accuracy = 0.01 # here\nend\nsubsection Statistics\n"}},
         {"Study/Accuracy = '0.01'", "no study 'results/study/study.json'", "taut --study"}},
        {"accuracy_beyond_one",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Accuracy = 2 # here\nend\nsubsection Statistics\n"}},
         {"Study/Accuracy = '2'", "v <= 1"}},
        {"study_without_runs",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Repeats = 0 # here\nend\nsubsection Statistics\n"}},
         {"Study/Repeats = '0'"}},
        {"parameter_of_an_unknown_entry",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries = "
           "Time/Stop "
           "# here\nset Values = 1, 2\nend\nend\nsubsection Statistics\n"}},
         {"Study/Parameter step/Entries", "no entry 'Time/Stop'", "did you mean 'Time/Step'"}},
        {"parameter_without_entries",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries =  # "
           "here\nset Values = 1, 2\nend\nend\nsubsection Statistics\n"}},
         {"Study/Parameter step/Entries", "name the entries"}},
        {"parameter_of_the_results",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries = "
           "Output/Folder # here\nset Values = a, b\nend\nend\nsubsection Statistics\n"}},
         {"Study/Parameter step/Entries", "not part of the scene"}},
        {"parameter_of_an_entry_twice",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries = "
           "Time/Step, "
           "Time/Step # here\nset Values = 1, 2\nend\nend\nsubsection Statistics\n"}},
         {"Study/Parameter step/Entries", "varied twice"}},
        {"parameter_with_an_empty_value",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries = "
           "Time/Step\nset Values = 1, , 2 # here\nend\nend\nsubsection Statistics\n"}},
         {"Study/Parameter step/Values", "none of them empty"}},
        {"parameter_without_values",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries = "
           "Time/Step\nset Values =  # here\nend\nend\nsubsection Statistics\n"}},
         {"Study/Parameter step/Values", "one or more values"}},
        {"refined_ladder_of_names",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries = "
           "Time/Scheme\nset Values = BDF2 # here\nset Refined = true\nend\nend\nsubsection "
           "Statistics\n"}},
         {"Study/Parameter step/Values = 'BDF2'", "cannot be halved", "Refined = false"}},
        {"refined_ladder_of_zero",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Parameters = step\nsubsection Parameter step\nset Entries = "
           "Time/Step\nset Values = 0.1, 0 # here\nset Refined = true\nend\nend\nsubsection "
           "Statistics\n"}},
         {"Study/Parameter step/Values", "'0' is no positive number"}},
        {"figure_without_a_name",
         network,
         {{"subsection Statistics\n",
           "subsection Study\nset Quantities = impulse\nsubsection Quantity "
           "impulze # here\nend\nend\nsubsection Statistics\n"}},
         {"no section 'Quantity impulze'", "did you mean 'Quantity impulse'"}},

        // Time, output, statistics
        {"newmark_beta_zero",
         network,
         {{"= automatic", "= Newmark"}, {"set Beta = 0.25", "set Beta = 0 # here"}},
         {"Newmark", "needs a positive one"}},
        {"spectral_radius_out_of_range",
         network,
         {{"set Spectral radius = 0.8", "set Spectral radius = 1.5 # here"}},
         {"Time/Generalised-alpha/Spectral radius = '1.5'", "v <= 1"}},
        {"step_zero", network, {{"= 0.01\n", "= 0 # here\n"}}, {"Time/Step = '0'", "positive"}},
        {"step_longer_than_the_run",
         network,
         {{"set End    = 0.05", "set End = 0.005 # here"}},
         {"Time/End = '0.005'", "shorter than one step"}},
        {"too_many_steps",
         network,
         {{"= 0.01\n", "= 1e-30 # here\n"}},
         {"Time/Step = '1e-30'", "more than 1e10"}},
        {"folder_is_a_file",
         network,
         {{"= results", "= scene.prm # here"}},
         {"Output/Folder", "it is a file"}},
        {"folder_below_a_file",
         network,
         {{"= results", "= scene.prm/results # here"}},
         {"Output/Folder", "cannot make"}},
        {"folder_where_nobody_writes",
         network,
         {{"= results", "= /proc/taut # here"}},
         {"Output/Folder = '/proc/taut'", "cannot make"}},
        {"folder_without_name", network, {{"= results", "= # here"}}, {"Output/Folder"}},
        {"window_of_one_value",
         network,
         {{"set Window =", "set Window = 5 # here"}},
         {"Statistics/Window = '5'", "two numbers"}},
        {"window_backwards",
         network,
         {{"set Window =", "set Window = 5, 2 # here"}},
         {"Statistics/Window = '5, 2'", "swap"}},
        {"window_that_is_never_reached",
         catenary,
         {{"subsection Output",
           "subsection Statistics\nset Window = 30, 40 # here\nend\nsubsection "
           "Output"}},
         {"Statistics/Window = '30, 40'", "'one' goes from 5 to 6.3", "run longer"}},
        {"restitution_of_elastic_links",
         network,
         {{"set Stiffness = rigid", "set Stiffness = 1000"},
          {"  subsection Newmark",
           "  subsection Moreau-Jean\nset Restitution = 0.5 # here\nend\n  subsection Newmark"}},
         {"Restitution = '0.5'", "rigid unilateral links, and the scene has none"}},
        {"restitution_of_a_wire",
         network,
         {{"  subsection Newmark",
           "  subsection Moreau-Jean\nset Restitution = 0.5 # here\nend\n  subsection Newmark"}},
         {"Restitution = '0.5'", "at the rigid link 'stop'"}},
        {"restitution_beside_a_reduced_mass",
         network,
         {{"set Mass per length = 1", "set Mass per length = 1\nset Mass matrix = reduced"},
          {"set To        = line @ 6", "set To        = ground"},
          {"  subsection Newmark",
           "  subsection Moreau-Jean\nset Restitution = 0.5 # here\nend\n  subsection Newmark"}},
         {"Restitution = '0.5'", "body 'line (transverse)' is 'reduced'",
          "take another Mass matrix"}},
        {"velocities_of_a_reduced_mass",
         network,
         {{"set Mass per length = 1", "set Mass per length = 1\nset Mass matrix = reduced"},
          {"= automatic", "= Moreau-Jean"},
          {"  subsection Newmark",
           "  subsection Moreau-Jean\nset Conditions = gaps then velocities # here\nend\n"
           "  subsection Newmark"}},
         {"Conditions = 'gaps then velocities'", "body 'line (transverse)' is 'reduced'",
          "take 'gaps'"}},
        {"theta_of_gaps_then_velocities",
         network,
         {{"= automatic", "= Moreau-Jean"},
          {"  subsection Newmark",
           "  subsection Moreau-Jean\nset Theta = 0.7 # here\nset Conditions = gaps then "
           "velocities\nend\n  subsection Newmark"}},
         {"Theta = '0.7'", "set it to 0.5"}},
        {"restitution_of_gaps",
         network,
         {{"= automatic", "= Moreau-Jean"},
          {"  subsection Newmark",
           "  subsection Moreau-Jean\nset Restitution = 0.5 # here\nset Conditions = gaps\nend\n"
           "  subsection Newmark"}},
         {"Restitution = '0.5'", "a law of velocities", "'gaps then velocities'"}},
        {"empty_file", whole, {{"", "# nothing but a comment\n"}}, {"scene.prm: it sets no entry"}},
        {"tolerance_zero",
         network,
         {{"subsection Statistics\n",
           "subsection Solver\nset Contact tolerance = 0 # here\nend\nsubsection Statistics\n"}},
         {"Solver/Contact tolerance = '0'", "1e-15"}},
        {"no_bodies",
         whole,
         {{"", "set Generator = network\n"}},
         {"scene.prm", "the scene is empty", "name at least one"}},
    };
    return cases;
  }

  class BadInput : public testing::Test
  {
  protected:
    void SetUp() override
    {
      static int count = 0;
      folder = fs::temp_directory_path() /
               ("taut_bad_input_" + std::to_string(getpid()) + "_" + std::to_string(++count));
      fs::create_directories(folder / "results");
      write("results/used.prm", "earlier");
      write("results/links.csv", "earlier");
      before = fs::current_path();
      fs::current_path(folder);
    }

    void TearDown() override
    {
      fs::current_path(before);
      std::error_code ignored;
      fs::remove_all(folder, ignored);
    }

    void write(const std::string &name, const std::string &text)
    {
      std::ofstream(folder / name, std::ios::binary) << text;
    }

    std::string content(const std::string &name)
    {
      std::ifstream in(folder / name);
      return {std::istreambuf_iterator<char>(in), {}};
    }

    bool earlier_results_are_whole()
    {
      return content("results/used.prm") == "earlier" &&
             content("results/links.csv") == "earlier" &&
             std::distance(fs::directory_iterator(folder / "results"), {}) == 2;
    }

    /// The error of reading and running a file, as the program prints it; empty if there is none.
    std::string error_of(const std::string &file, const Texts &overrides = {},
                         bool overwrite = true)
    {
      taut::Parameters parameters;
      std::ostringstream log;
      try
      {
        parameters.read(file, overrides);
        parameters.output.overwrite = overwrite;
        taut::check_results_folder(parameters);
        taut::Simulation(parameters, log).run();
      }
      catch (const taut::EntryError &e)
      {
        EXPECT_TRUE(exists(e.entry(), parameters.values())) << "no entry or section " << e.entry();
        return parameters.explain(e);
      }
      catch (const taut::UserError &e)
      {
        return e.what();
      }
      return "";
    }

    /// Whether an entry or a section of this path is among the entries; the whole file has none.
    static bool exists(const std::string &path, const std::map<std::string, std::string> &entries)
    {
      return path.empty() ||
             std::any_of(entries.begin(), entries.end(),
                         [&](const auto &entry)
                         { return entry.first == path || entry.first.rfind(path + "/", 0) == 0; });
    }

    fs::path folder, before;
  };

  /// Line of the mark "# here", and the text without it.
  int find_mark(std::string &text)
  {
    const std::size_t at = text.find(" # here");
    if (at == std::string::npos)
      return 0;
    int line = 1;
    for (std::size_t i = 0; i < at; ++i)
      line += text[i] == '\n';
    text.erase(at, 7);
    return line;
  }

  void expect_fragments(const std::string &message, const Texts &fragments)
  {
    EXPECT_NE(message, "") << "accepted";
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string &fragment : fragments)
      EXPECT_NE(message.find(fragment), std::string::npos)
          << "'" << fragment << "' is missing in: " << message;
  }

  std::string change(std::string text, const Changes &changes)
  {
    for (const auto &[from, to] : changes)
    {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << "the scene has no '" << from << "'";
      if (at != std::string::npos)
        text.replace(at, from.size(), to);
    }
    return text;
  }
} // namespace

TEST_F(BadInput, TheScenesBeforeTheChangesRun)
{
  for (const char *scene : {network, catenary})
  {
    write("scene.prm", scene);
    EXPECT_EQ(error_of("scene.prm"), "");
  }
}

TEST_F(BadInput, EachMistakeIsNamedWithItsPlaceAndRemedy)
{
  std::set<std::string> names;
  for (const Case &c : table())
  {
    SCOPED_TRACE(c.name);
    EXPECT_TRUE(names.insert(c.name).second);
    write("results/used.prm", "earlier");
    write("results/links.csv", "earlier");
    std::string text = change(c.scene, c.changes);
    const int line = find_mark(text);
    Texts fragments = c.fragments;
    if (line > 0)
      fragments.push_back("scene.prm:" + std::to_string(line) + ":");
    write("scene.prm", text);
    const std::string message = error_of("scene.prm");
    expect_fragments(message, fragments);
    if (c.in_run)
    {
      fs::remove_all(folder / "results");
      fs::create_directories(folder / "results");
    }
    else
      EXPECT_TRUE(earlier_results_are_whole());
    if (std::getenv("TAUT_PRINT_MESSAGES"))
      std::printf("%s\n  %s\n", c.name, message.c_str());
  }
  EXPECT_GE(names.size(), 40u);
}

TEST_F(BadInput, FilesThatCannotBeRead)
{
  expect_fragments(error_of("nowhere.prm"), {"cannot read 'nowhere.prm'", "no such file"});
  expect_fragments(error_of("scene.json"), {"scene.json: scenes are not", "take a .prm file"});
  write("scene_250.prm", network);
  expect_fragments(error_of("scene_25.prm"), {"no such file", "did you mean 'scene_250.prm'"});
  expect_fragments(error_of("results"), {"cannot read 'results'", "it is a folder"});
  fs::create_directories("folder.prm");
  expect_fragments(error_of("folder.prm"), {"cannot read 'folder.prm'", "it is a folder"});
  write("a.prm", "set Start = given\ninclude b.prm\n");
  write("b.prm", "# back\ninclude ./a.prm\n");
  expect_fragments(error_of("a.prm"), {"b.prm:2:", "include itself"});
  EXPECT_TRUE(earlier_results_are_whole());
}

TEST_F(BadInput, ChangesOnTheCommandLine)
{
  write("scene.prm", network);
  const std::vector<std::pair<std::string, Texts>> cases = {
      {"Time.Step", {"--set 'Time.Step'", "Section.Entry=value"}},
      {"=3", {"--set", "Section.Entry=value"}},
      {"Time.Stp=3", {"--set", "no entry 'Stp'", "did you mean 'Step'"}},
      {"Time.Stiffness=1",
       {"no entry 'Stiffness' in 'Time'", "There is 'Network/Link hanger/Stiffness' and"}},
      {"Link stop/To=ground", {"no section 'Link stop'", "There is 'Network/Link stop'"}},
      {"Time.Step=0,001", {"--set: Time/Step = '0,001'", "decimals have a point"}},
      {"Time.Step=fast", {"--set: Time/Step = 'fast'", "not allowed"}},
      {"Time..Step=1", {"--set", "empty"}},
      {"Foo=1", {"no entry 'Foo'", "Generator", "Sections here: ", "Network", "Time"}},
      {"Time.Step=1\\", {"--set: Time/Step", "continues a line"}},
      {"Time.Step=1 # 2", {"--set", "no '#'"}},
  };
  for (const auto &[assignment, fragments] : cases)
  {
    SCOPED_TRACE(assignment);
    expect_fragments(error_of("scene.prm", {assignment}), fragments);
    EXPECT_TRUE(earlier_results_are_whole());
  }
}

TEST_F(BadInput, ResultsOfAnEarlierRunStayWithoutOverwrite)
{
  write("scene.prm", network);
  expect_fragments(error_of("scene.prm", {}, false),
                   {"scene.prm:", "Output/Folder = 'results'", "--overwrite"});
  EXPECT_TRUE(earlier_results_are_whole());

  // A table of somebody else's without a run beside it is as much worth.
  fs::remove("results/used.prm");
  expect_fragments(error_of("scene.prm", {}, false), {"Output/Folder = 'results'", "--overwrite"});
  EXPECT_EQ(content("results/links.csv"), "earlier");

  // Files that no run writes are left alone.
  fs::remove("results/links.csv");
  write("results/notes.txt", "mine");
  EXPECT_EQ(error_of("scene.prm", {}, false), "");
  EXPECT_EQ(content("results/notes.txt"), "mine");
}

TEST_F(BadInput, EarlierResultsAreFoundBeforeTheWork)
{
  // The lengths of these droppers cannot be found: whoever hears of that first has searched.
  write("scene.prm", change(catenary, {{"set Pre-sag   =", "set Pre-sag = 0.1, 0.5, 0.1"}}));
  expect_fragments(error_of("scene.prm", {}, false), {"Output/Folder = 'results'", "--overwrite"});
  expect_fragments(error_of("scene.prm", {}, true), {"would have to push"});
  EXPECT_TRUE(earlier_results_are_whole());
}

TEST_F(BadInput, EntriesOfAnotherSchemeAreSaidNotToBeUsed)
{
  write("scene.prm", network);
  const auto log_and_used = [&](const Texts &overrides)
  {
    taut::Parameters parameters;
    std::ostringstream log;
    parameters.read("scene.prm", overrides);
    parameters.output.overwrite = true;
    taut::Simulation(parameters, log).run();
    return log.str() + content("results/used.prm");
  };
  // The rigid stop of the scene makes 'automatic' choose another scheme.
  const std::string said = log_and_used({"Time.Generalised-alpha.Spectral radius=0.5"});
  for (const char *sentence :
       {"  not used by it: Time/Generalised-alpha/Spectral radius = 0.5\n",
        "# Not used by it: Time/Generalised-alpha/Spectral radius = 0.5\n", "# The scheme was "})
    EXPECT_NE(said.find(sentence), std::string::npos) << said;
  // A default is not worth a word, however it is written.
  EXPECT_EQ(log_and_used({"Time.Generalised-alpha.Spectral radius=0.80"}).find("ot used by it"),
            std::string::npos);
  EXPECT_EQ(log_and_used({"Time.Scheme=generalised-alpha", "Time.Allow unsuitable scheme=true",
                          "Time.Generalised-alpha.Spectral radius=0.5"})
                .find("ot used by it"),
            std::string::npos);
}

TEST_F(BadInput, ARunThatFailsKeepsWhatItHad)
{
  write("scene.prm", change(network, {{"= 10*t", "= sqrt(0.025-t)"}}));
  EXPECT_NE(error_of("scene.prm"), "");
  std::istringstream lines(content("results/certificate.csv"));
  int n = 0;
  for (std::string line; std::getline(lines, line);)
    ++n;
  EXPECT_EQ(n, 4) << "head, start and two steps";
  EXPECT_NE(content("results/statistics.json").find("\"partial\": true"), std::string::npos);
}
