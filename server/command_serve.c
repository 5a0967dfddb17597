#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "interrupt.h"
#include "websocket.h"

typedef struct ServeOptions {
    const char *path, *bind, *backend, *data, *page;
    int port, threads;
    OptionList overrides;
} ServeOptions;

static OptionsResult read_options(int count, char **words, ServeOptions *to, Error *error)
{
    const Option options[] = {
        {"--port", "N", OPTION_INTEGER, false, &to->port, 0, 65535, NULL,
         "port of the page; 0 takes any free one"},
        {"--bind", "ADDRESS", OPTION_TEXT, false, &to->bind, 0, 0, NULL,
         "address to listen at; 0.0.0.0 lets other machines in"},
        {"--threads", "N", OPTION_INTEGER, false, &to->threads, 0, 1024, NULL,
         "threads of the solver; 0 takes all cores"},
        {"--backend", "B", OPTION_TEXT, false, &to->backend, 0, 0, "auto|cpu|cuda",
         "auto, cpu or cuda"},
        {"--data", "DIR", OPTION_TEXT, false, &to->data, 0, 0, NULL,
         "folder for series and journals, one subfolder per start"},
        {"--set", "path=value", OPTION_LIST, false, &to->overrides, 0, 0, NULL,
         "change a value of the case"},
        {"--page", "DIR", OPTION_TEXT, false, &to->page, 0, 0, NULL,
         "folder of the built page (default: found beside the program)"},
    };
    OptionTable table = {
        .command = "serve",
        .summary = "Simulate a case, draw it, and show it in a web page where it can be steered.",
        .positional = "CASE",
        .positional_value = &to->path,
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .notes = "CASE is a JSON file (default " DEFAULT_CASE ").",
    };
    return options_parse(&table, count, words, stdout, error);
}

/// The page lies beside the program's folder, or where it was built.
static const char *find_page(const char *page, char *room, int size)
{
    if (page) return page;
    char folder[SCENE_PATH_SIZE], index[3 * SCENE_PATH_SIZE];
    program_folder(folder, sizeof folder);
    snprintf(room, (size_t)size, "%s/../web/dist", folder);
    snprintf(index, sizeof index, "%s/index.html", room);
    return access(index, R_OK) ? WEB_DIST : room;
}

static void announce(const ServeOptions *options, const WebServer *server, const Prepared *prepared,
                     const Session *session, const Pictures *pictures)
{
    const Plan *plan = prepared->plan;
    const char *address = strcmp(options->bind, "0.0.0.0") ? options->bind : "localhost";
    printf("Fairlead %s is at http://%s:%d/\n", FAIRLEAD_VERSION, address, web_server_port(server));
    printf("  case      %s (%d particles, %d threads, %s)\n", prepared->scene->name,
           plan->fluid_count + plan->wall_count + plan->body_particle_count, plan->options.threads,
           plan->variant);
    printf("  pictures  %s\n", pictures_renderer(pictures));
    printf("  data      %s\n", session_folder(session));
    if (!web_server_has_page(server)) printf("  page      not built: ./fairlead build\n");
    if (plan->warnings[0]) printf("  warning   %s\n", plan->warnings);
    fflush(stdout);
}

/// With everything made: three threads until a signal comes.
static bool serve(const ServeOptions *options, WebServer *server, const Prepared *prepared,
                  Session *session, Pictures *pictures, const ViewOptions *view, Error *error)
{
    HubParts parts = {.scene = prepared->scene,
                      .plan = prepared->plan,
                      .table = prepared->table,
                      .session = session,
                      .pictures = pictures,
                      .view = *view};
    Hub *hub = hub_create(&parts, error);
    if (!hub) return false;
    bool good = session_start(session, error);
    interrupt_unblock();
    if (good) {
        announce(options, server, prepared, session, pictures);
        web_server_run(server, hub, &interrupt_came);
        printf("stopping\n");
    }
    // first the threads that wake the socket, then the sockets that use the hub
    pictures_stop(pictures);
    session_stop(session);
    web_server_destroy(server);
    hub_destroy(hub);
    return good;
}

static bool serve_case(const ServeOptions *options, WebServer *server, const Prepared *prepared,
                       Error *error)
{
    ViewOptions view = view_options_default();
    view.width = 960;
    view.height = 540;
    view.overlay = true;
    view.camera = camera_for_scene(prepared->scene);
    Wake to_wake = {web_server_wake, server};
    Pictures *pictures = NULL;
    Session *session = session_create(prepared->scene, prepared->plan, prepared->table,
                                      options->data, to_wake, error);
    if (session) pictures = pictures_create(session, &view, to_wake, error);
    bool good = pictures != NULL;
    if (good)
        good = serve(options, server, prepared, session, pictures, &view, error);
    else
        web_server_destroy(server);
    pictures_destroy(pictures);
    session_destroy(session);
    return good;
}

int command_serve(int count, char **words)
{
    ServeOptions options = {
        .bind = "127.0.0.1", .backend = "auto", .data = "fairlead-data", .port = 8080};
    Error error = {0};
    OptionsResult result = read_options(count, words, &options, &error);
    if (result == OPTIONS_HELP) return EXIT_GOOD;
    if (result == OPTIONS_REFUSED) return report(&error);
    char path[2 * SCENE_PATH_SIZE], page[2 * SCENE_PATH_SIZE];
    EngineOptions engine = {
        .threads = options.threads, .backend = options.backend, .pictures = true};
    WebOptions web = {options.bind, options.port, find_page(options.page, page, sizeof page)};
    Prepared prepared;
    interrupt_catch();
    interrupt_block();
    if (!options.path) options.path = find_default_case(path, sizeof path);
    if (!prepare(options.path, &options.overrides, &engine, &prepared, &error))
        return report(&error);
    WebServer *server = web_server_create(&web, &error);
    bool good = server && serve_case(&options, server, &prepared, &error);
    prepared_destroy(&prepared);
    return good ? EXIT_GOOD : report(&error);
}
