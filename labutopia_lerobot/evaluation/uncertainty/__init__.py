"""How far numbers of finitely many episodes can be trusted; knows nothing of rows."""
