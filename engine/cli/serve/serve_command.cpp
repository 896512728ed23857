// `palpate serve`: the engine here, with real devices; the picture in any browser with a token.
#include <memory>

#include "cli/kit/commands.h"
#include "cli/kit/device_option.h"
#include "cli/kit/number_option.h"
#include "cli/serve/served_run.h"

namespace palpate::app {

namespace {

Option* addToken(Command& command, const std::string& name, std::string& token, const std::string& help) {
  return command.add_option(name, token, help)->type_name("TOKEN")->check([](const std::string& given) {
    return serving::faultOfToken(given);
  });
}

void addAccess(Command& command, serving::ServeOptions& options) {
  command
      .add_option("--host", options.host,
                  "Address of this computer to listen at; another than loopback needs a token that you give")
      ->capture_default_str();
  addSetting(command, "--port", options.port, between(0, 65535), "Port to listen at; 0: any that is free");
  addToken(command, "--token", options.tokens.control,
           "Who has it may move the finger, one at a time (default: one is made and printed)");
  addToken(command, "--look-token", options.tokens.look, "Who has it looks on; likewise");
  addToken(command, "--instruct-token", options.tokens.instruct,
           "Who has it may take the finger from anybody, pause it and write to all; likewise");
  command.add_option("--token-file", options.token_file,
                     "Read the three tokens from this file of yours alone (mode 600), or write those that are made; "
                     "other users see the words of a command, not its files");
  Option* certificate = command
                            .add_option("--tls-cert", options.tls_cert,
                                        "Certificate (PEM, with those that it is signed by) for HTTPS; needs "
                                        "--tls-key")
                            ->type_name("FILE");
  Option* key =
      command.add_option("--tls-key", options.tls_key, "Its key (PEM, not readable by others)")->type_name("FILE");
  certificate->needs(key);
  key->needs(certificate);
  command
      .add_option("--origin", options.origins,
                  "A page from there may look too, for a proxy: https://place.example; once for each")
      ->type_name("URL")
      ->allow_extra_args(false);
  addSetting(command, "--onlookers", options.watchers, between(1, 1000), "How many may look on at once");
}

}  // namespace

void addServeFamily(Command& app) {
  const auto options = std::make_shared<serving::ServeOptions>();
  Command& command = *app.add_subcommand(
      "serve", "Feel here, with devices, and show it in browsers: the skin is deformed there (docs/howto/serve.md)");
  options->input.needs_fingers = false;
  addInputOptions(command, options->input);
  addNumber(command, "--seconds", options->input.seconds, above(0.0, 864000.0, "s"),
            "End by itself after so long (default: Ctrl+C ends it)");
  addDeviceOption(command, options->devices,
                  "Holds the left finger, the right one when given again; the others are moved by pages");
  addAccess(command, *options);
  command.add_option("--site", options->site,
                     "Folder of the page (tools/build-web) (default: the installed one, where there is one)");
  command.add_option("--record", options->recording, "Record every tick into this file (docs/reference/recordings.md)")
      ->type_name("FILE");
  command.add_flag("--overwrite", options->overwrite, "Replace a recording of that name");
  command.add_flag("--json", options->json,
                   "Print one JSON line with address and file of tokens at the start, and one with counts at the end");
  command.callback([options, &command] {
    options->input.radius_given = command.count("--radius-mm") > 0;
    serving::serve(*options);
  });
}

}  // namespace palpate::app
