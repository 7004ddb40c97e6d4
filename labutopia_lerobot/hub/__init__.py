"""Publishing on the Hugging Face Hub: datasets, policies and the environment, with cards."""
