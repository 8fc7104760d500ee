#pragma once
/// Command line of `septet accident`.

#include "sim-client/film/accident/accident_film.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace septet::film {

/// Declares all options to the parser, which holds pointers into `options`.
void add_accident_options(CLI::App& app, AccidentOptions& options);

}  // namespace septet::film
