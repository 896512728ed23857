// `palpate serve`: the engine here, with real devices; the picture in any browser with a token.
#include <memory>

#include "cli/kit/device_option.h"
#include "cli/kit/number_option.h"
#include "cli/own/commands.h"
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
                  "Address to listen on; any other than loopback requires --token or --token-file")
      ->capture_default_str();
  addSetting(command, "--port", options.port, between(0, 65535), "Port to listen on; 0 chooses a free one");
  addToken(command, "--token", options.tokens.control,
           "Token for controlling a finger, one user at a time (default: generated and printed)");
  addToken(command, "--look-token", options.tokens.look, "Token for watching (default: generated and printed)");
  addToken(command, "--instruct-token", options.tokens.instruct,
           "Token for instructors, who can take over a finger, pause it and message everyone (default: generated and "
           "printed)");
  command.add_option("--token-file", options.token_file,
                     "Private file (mode 600) to read the three tokens from, or to write generated ones to; safer than "
                     "options, which other users can see");
  Option* certificate =
      command
          .add_option("--tls-cert", options.tls_cert, "Certificate for HTTPS (PEM, with its chain); requires --tls-key")
          ->type_name("FILE");
  Option* key =
      command.add_option("--tls-key", options.tls_key, "Private key of the certificate (PEM, not readable by others)")
          ->type_name("FILE");
  certificate->needs(key);
  key->needs(certificate);
  command
      .add_option("--origin", options.origins,
                  "Also accept pages from this origin, e.g. behind a proxy: https://place.example; repeatable")
      ->type_name("URL")
      ->allow_extra_args(false);
  addSetting(command, "--onlookers", options.watchers, between(1, 1000), "Maximum number of viewers at a time");
}

}  // namespace

void addServeFamily(Command& app) {
  const auto options = std::make_shared<serving::ServeOptions>();
  Command& command = *app.add_subcommand(
      "serve",
      "Serve palpation with local devices to browsers, which deform the skin themselves (docs/howto/serve.md)");
  options->input.needs_fingers = false;
  addInputOptions(command, options->input);
  addNumber(command, "--seconds", options->input.seconds, above(0.0, 864000.0, "s"),
            "Stop after this time (default: on Ctrl+C)");
  addDeviceOption(command, options->devices,
                  "Device for the left finger; repeat for the right one; pages move the others");
  addAccess(command, *options);
  command.add_option("--site", options->site,
                     "Folder of the page made by tools/build-web (default: the installed one, if any)");
  command.add_option("--record", options->recording, "Record every tick into this file (docs/reference/recordings.md)")
      ->type_name("FILE");
  command.add_flag("--overwrite", options->overwrite, "Replace an existing recording of that name");
  command.add_flag("--json", options->json,
                   "Print a JSON line with address and token file at the start, and one with counts at the end");
  command.callback([options, &command] {
    options->input.radius_given = command.count("--radius-mm") > 0;
    serving::serve(*options);
  });
}

}  // namespace palpate::app
