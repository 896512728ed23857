// The subcommands of `palpate bench` that measure the whole program rather than one room, and its regression guard.
#pragma once

namespace CLI {
class App;
}

namespace palpate::app {

// `bench` is the bench command.
void addBenchBaseline(CLI::App& bench);  ///< no subcommand: `palpate bench --baseline FILE`
void addBenchLoadCommand(CLI::App& bench);
void addBenchServoCommand(CLI::App& bench);

}  // namespace palpate::app
