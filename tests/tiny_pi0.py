"""Makes pi0 and pi0.5 small enough for a test: in LeRobot 0.6.1 they have 3.5 billion parameters.

A LeRobot plugin: `tiny_vla.py` puts it on the path as the distribution `lerobot_policy_tiny_pi0`,
so that LeRobot's programs and the evaluator import it by themselves. It replaces the table of
sizes, and those of vision tower and vocabulary, which LeRobot has as literals; nothing else.
"""

from typing import Any

from lerobot.policies.pi0 import modeling_pi0
from lerobot.policies.pi05 import modeling_pi05
from transformers import PaliGemmaConfig

VOCABULARY = 512
SIZE = modeling_pi0.GemmaConfig(
    width=32, depth=2, mlp_dim=64, num_heads=8, num_kv_heads=1, head_dim=8
)
"""Eight heads, which are a literal in LeRobot's attention as well."""


class TinyPaliGemma(modeling_pi0.PaliGemmaForConditionalGenerationWithPiGemma):
    def __init__(self, config: PaliGemmaConfig) -> None:
        seen = config.vision_config
        seen.hidden_size = seen.projection_dim = SIZE.width
        seen.intermediate_size = SIZE.mlp_dim
        seen.num_hidden_layers, seen.num_attention_heads = SIZE.depth, SIZE.num_heads
        config.text_config.vocab_size = VOCABULARY
        super().__init__(config)


class TinyExpert(modeling_pi0.PiGemmaForCausalLM):
    def __init__(self, config: Any) -> None:
        config.vocab_size = VOCABULARY
        super().__init__(config)


for model in (modeling_pi0, modeling_pi05):
    model.get_gemma_config = lambda variant: SIZE
    model.PaliGemmaForConditionalGenerationWithPiGemma = TinyPaliGemma
    model.PiGemmaForCausalLM = TinyExpert
