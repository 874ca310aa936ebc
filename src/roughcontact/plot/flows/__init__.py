"""Pictures of what flows through a contact and its gap."""
