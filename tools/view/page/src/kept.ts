// The file of rules as the server would save it. The page keeps it, so that a design outlives its server.
import { rules as askRules, type State } from './api';

export class Kept {
  private text = '';
  revision = 0;  // of the design that `text` has
  private asking = false;
  constructor(private link: HTMLAnchorElement) {}

  /// Fetches the rules of the present design, one request at a time. Without an answer, the page keeps what it has.
  async follow(state: () => State): Promise<void> {
    if (this.asking) return;
    this.asking = true;
    try {
      while (this.revision !== state().design.revision) {
        const { revision } = state().design;
        this.text = await askRules();
        this.revision = revision;
      }
    } catch { /* the events tell that the server is gone */ }
    this.asking = false;
  }

  /// Offers the rules as a download if they are saved nowhere.
  offer({ design, rules_file }: State): void {
    const name = rules_file.split('/').at(-1)!;
    URL.revokeObjectURL(this.link.href);
    this.link.href = URL.createObjectURL(new Blob([this.text], { type: 'application/json' }));
    this.link.download = name;
    this.link.textContent = `Download ${name}`;
    this.link.title = `bpview … --rules ${name} goes on from it`;
    this.link.hidden = this.text === '' || design.saved || !(design.can_undo || design.can_redo);
  }
  withdraw(): void { this.link.hidden = true; }
}
