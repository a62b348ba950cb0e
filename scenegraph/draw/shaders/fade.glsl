// Of what is between two levels.
layout(location = 6) flat in float share;
void keep_own_share() { keep_share(share); }
