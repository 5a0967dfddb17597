#include "effects.h"

static const char *const KINDS[] = {"pair", "pass"};
static const char *const COSTS[] = {"clocked", "sampled", "elsewhere"};

void effects_write(Json *json, const Plan *plan)
{
    json_array(json, "effects");
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const EffectPlan *effect = &plan->effects[i];
        json_object(json, NULL);
        json_string(json, "name", effect->name);
        json_string(json, "kind", KINDS[effect->kind]);
        json_bool(json, "active", effect->active);
        json_string(json, "because", effect->because);
        json_string(json, "called_by", effect->called_by);
        json_integer(json, "bytes", (int64_t)effect->bytes);
        json_string(json, "arrays", effect->arrays);
        json_number(json, "step_limit_s", effect->step_limit);
        json_string(json, "step", effect->step);
        json_string(json, "cost", COSTS[effect->cost]);
        json_string(json, "source", effect->source);
        json_object_end(json);
    }
    json_array_end(json);
}

void effects_write_costs(Json *json, const Plan *plan, const State *state)
{
    double total = state->base_seconds;
    for (int i = 0; i < EFFECT_COUNT; i++)
        total += state->effect_seconds[i];
    json_array(json, "effects");
    for (int i = 0; i < EFFECT_COUNT; i++) {
        const EffectPlan *effect = &plan->effects[i];
        if (!effect->active) continue;
        json_object(json, NULL);
        json_string(json, "name", effect->name);
        json_string(json, "kind", KINDS[effect->kind]);
        json_integer(json, "bytes", (int64_t)effect->bytes);
        json_string(json, "cost", COSTS[effect->cost]);
        json_number(json, "wall_s", state->effect_seconds[i]);
        json_number(json, "share", total > 0 ? state->effect_seconds[i] / total : 0);
        json_object_end(json);
    }
    json_array_end(json);
}
